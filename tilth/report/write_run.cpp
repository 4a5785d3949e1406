#include <functional>

#include <tilth/core/error.hpp>
#include <tilth/io/g2o.hpp>
#include <tilth/io/las.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/report/html_report.hpp>
#include <tilth/report/run_report.hpp>
#include <tilth/report/write_run.hpp>
#include <tilth/run/summary_json.hpp>

namespace tilth {
namespace {

struct RunFile {
  std::string name;
  std::function<void(const std::filesystem::path&, const RunRecord&)> write;
};

void write_mcap(const std::filesystem::path& path, const RunRecord& run) {
  run.mcap ? run.mcap->finish(run) : RunMcap(path, 0).finish(run);
}

/// Every file that `options` ask for.
std::vector<RunFile> files(const OutputOptions& options) {
  using Path = std::filesystem::path;
  std::vector<RunFile> all{
      {"trajectory.tum", [](const Path& path, const RunRecord& run) { write_tum(path, run.trajectory); }},
      {"trajectory_kitti.txt", [](const Path& path, const RunRecord& run) { write_kitti_poses(path, run.trajectory); }},
      {"scans.csv", [](const Path& path, const RunRecord& run) { write_scan_table(path, run.scans); }},
      {"summary.json", [](const Path& path, const RunRecord& run) { write_text(path, summary_json(run)); }}};
  const std::set<std::string> maps = map_formats(options);
  if (maps.contains("pcd"))
    all.push_back({"map.pcd", [](const Path& path, const RunRecord& run) { write_pcd(path, run.map.records()); }});
  if (maps.contains("ply"))
    all.push_back({"map.ply", [](const Path& path, const RunRecord& run) { write_ply(path, run.map.records()); }});
  if (maps.contains("las"))
    all.push_back({"map.las", [](const Path& path, const RunRecord& run) { write_las(path, run.map.records()); }});
  all.push_back({"report.html", [](const Path& path, const RunRecord& run) {
                   write_report(path.parent_path(), report_of(run, run.report.points));
                 }});
  if (options.mcap) all.push_back({"run.mcap", write_mcap});
  return all;
}

const std::vector<RunFile>& loop_files() {
  using Path = std::filesystem::path;
  static const std::vector<RunFile> all{
      {"trajectory_odometry.tum", [](const Path& path, const RunRecord& run) { write_tum(path, run.loops->odometry); }},
      {"closures.csv", [](const Path& path, const RunRecord& run) { write_closures(path, run.loops->closures); }},
      {"pose_graph.g2o", [](const Path& path, const RunRecord& run) { write_g2o(path, run.loops->graph); }}};
  return all;
}

std::vector<RunFile> files_of(const OutputOptions& options, bool loop_closure) {
  std::vector<RunFile> all = files(options);
  if (loop_closure) all.insert(all.end(), loop_files().begin(), loop_files().end());
  return all;
}

}  // namespace

std::vector<std::string> run_files(const OutputOptions& options, bool loop_closure) {
  std::vector<std::string> names;
  for (const RunFile& file : files_of(options, loop_closure)) names.push_back(file.name);
  return names;
}

std::vector<std::string> write_run(const std::filesystem::path& folder, const RunRecord& record,
                                   const std::set<std::string>& kept) {
  std::vector<std::string> failures;
  for (const RunFile& file : files_of(record.output, record.loops.has_value())) {
    if (kept.contains(file.name)) continue;
    try {
      file.write(folder / file.name, record);
    } catch (const std::exception& e) {
      failures.emplace_back(e.what());
    }
  }
  return failures;
}

}  // namespace tilth
