#include <array>
#include <chrono>
#include <utility>

#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/journal_sink.hpp>
#include <tilth/run/summary_json.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPoses = "trajectory.tum";
constexpr const char* kRows = "scans.csv";
constexpr const char* kMap = "map.pcd";
constexpr const char* kSummary = "summary.json";

/// The points of a map, as MapBuilder wrote them.
PointCloud map_in_world(const fs::path& path) {
  const PointRecords records = read_pcd(path);
  std::array<std::vector<double>, 4> values;
  constexpr std::array kNames{"x", "y", "z", "intensity"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const PointField* field = records.find(kNames[i]);
    if (field == nullptr)
      throw Error(path.string(), "has no field " + std::string(kNames[i]) + ": is it the map of a run?");
    values[i] = column(records, *field);
  }
  PointCloud cloud;
  for (std::size_t i = 0; i < records.count; ++i) {
    cloud.points.emplace_back(values[0][i], values[1][i], values[2][i]);
    cloud.intensities.push_back(float(values[3][i]));
  }
  return cloud;
}

std::string first_line(const fs::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string_view text = as_text(bytes);
  return std::string(text.substr(0, text.find('\n') + 1));
}

/// Poses of two bodies make no trajectory: where the folder says of which its poses are, it must be the same.
void require_same_mount(const fs::path& summary, const RunRecord& record) {
  if (!fs::exists(summary)) return;
  const std::vector<std::byte> bytes = read_file(summary);
  const auto before = nlohmann::json::parse(as_text(bytes), nullptr, false);
  const auto frames = before.is_object() ? before.value("frames", nlohmann::json()) : nlohmann::json();
  const auto mount = frames.is_object() ? frames.value("T_base_lidar", nlohmann::json()) : nlohmann::json();
  const auto now = record.T_base_lidar ? nlohmann::json(mount_numbers(*record.T_base_lidar)) : nlohmann::json();
  if (mount == now) return;
  throw Error(summary.string(), "has T_base_lidar " + mount.dump() + ", this run " + now.dump() +
                                    ": it can only be resumed with the same --base-from-lidar");
}

}  // namespace

bool holds_run(const fs::path& folder) {
  return keep_whole_lines(folder / kPoses) > 0;
}

std::vector<std::string> continue_run(const fs::path& folder, RunRecord& record) {
  require_same_mount(folder / kSummary, record);
  keep_whole_lines(folder / kRows);
  record.trajectory = poses_of_lidar(read_tum(folder / kPoses), record.T_base_lidar);
  if (!fs::exists(folder / kMap)) return {folder.string() + " has no map yet: the new one begins here"};
  record.map.add(map_in_world(folder / kMap), Pose::Identity(), 0.0, {});
  return {};
}

void remove_run(const fs::path& folder, std::span<const std::string> files) {
  for (const std::string& file : files) fs::remove(folder / file);
  for (const std::string& file : journal_files(false)) fs::remove(folder / file);
}

std::set<std::string> journal_files(bool loop_closure) {
  std::set<std::string> files{kRows, kMap};
  if (!loop_closure) files.insert(kPoses);
  return files;
}

JournalSink::JournalSink(const fs::path& folder, double checkpoint_seconds, RunObserver& observer)
    : folder_(folder),
      checkpoint_seconds_(checkpoint_seconds),
      observer_(observer),
      poses_(folder / kPoses, false),
      rows_(folder / kRows, false) {}

JournalSink::~JournalSink() = default;

void JournalSink::take(const Scan&, const OdometryResult&, const RunRecord& record) {
  append(record);
  if (since_checkpoint_.seconds() < checkpoint_seconds_) return;
  since_checkpoint_ = Stopwatch();
  const std::string problem = checkpoint(record);
  if (!problem.empty()) observer_.warn("the last checkpoint could not be written: " + problem);
  observer_.note(std::to_string(record.trajectory.size()) + " scans registered, " + std::to_string(record.map.size()) +
                 " points in the map");
}

void JournalSink::append(const RunRecord& record) {
  const std::size_t index = record.trajectory.size() - 1;
  const StampedPose& pose = record.trajectory[index];
  if (index > 0 && !(pose.stamp > record.trajectory[index - 1].stamp)) {
    throw Error((folder_ / kPoses).string(),
                "cannot go on: stamp " + std::to_string(pose.stamp) + " s does not lie after that of its last pose");
  }
  const std::vector<std::string>& stages = record.scans.stages;
  if (!columns_known_) {
    const std::string header = scan_table_header(stages);
    if (rows_.empty())
      rows_.write_line(header);
    else if (first_line(folder_ / kRows) != header)
      throw Error((folder_ / kRows).string(), "has other columns: it was written by another pipeline or version");
    columns_known_ = true;
  }
  rows_.write_line(scan_table_row(record.scans.rows.back(), index, stages.size()));
  poses_.write_line(tum_line({pose.stamp, pose_of_base(pose.T_world_lidar, record.T_base_lidar)}));
}

/// Begins to write map.pcd and summary.json from a copy, unless the last time is not over yet. What went wrong then, or
/// nothing.
std::string JournalSink::checkpoint(const RunRecord& record) {
  if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  const std::string problem = saving_.valid() ? saving_.get() : std::string{};
  const auto save = [folder = folder_, map = record.map.records(), summary = summary_json(record)]() -> std::string {
    try {
      write_pcd(folder / kMap, map);
      write_text(folder / kSummary, summary);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  };
  saving_ = std::async(std::launch::async, save);
  return problem;
}

void JournalSink::finish(const RunRecord& record) {
  if (saving_.valid()) saving_.wait();
  write_pcd(folder_ / kMap, record.map.records());
}

}  // namespace tilth
