#include <algorithm>
#include <string>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/file_kind.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/sources/folder_source.hpp>
#include <tilth/sources/recorded_source.hpp>
#include <tilth/sources/scan_files.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

PointRecords read_scan_file(const fs::path& path) {
  const std::string extension = kind_of_file(path);
  if (extension == ".pcd") return read_pcd(path);
  if (extension == ".ply") return read_ply(path);
  return read_kitti_bin(path);
}

/// KITTI's calibration has the projections of its cameras, or at least where the LiDAR is from them.
bool is_kitti_calibration(const fs::path& file) {
  if (!fs::is_regular_file(file)) return false;
  const std::vector<std::byte> bytes = read_file(file);
  TextLines lines(as_text(bytes));
  for (auto line = lines.next(); line; line = lines.next()) {
    if (line->starts_with("P0:") || line->starts_with("Tr:")) return true;
  }
  return false;
}

/// A KITTI odometry sequence, by its calibration: its folder was opened, or the velodyne/ in it.
bool is_kitti_sequence(const std::vector<fs::path>& files) {
  const fs::path folder = files.front().parent_path();
  const bool bins =
      std::all_of(files.begin(), files.end(), [](const fs::path& f) { return kind_of_file(f) == ".bin"; });
  return bins && folder.filename() == "velodyne" && is_kitti_calibration(folder.parent_path() / "calib.txt");
}

/// Of files without a header whose points are more or less than x y z intensity: what they are. Empty otherwise.
std::string columns_sentence(const fs::path& file) {
  if (kind_of_file(file) != ".bin") return "";
  try {
    const PointRecords records = read_kitti_bin(file);
    std::string names;
    for (const PointField& field : records.fields) names += " " + field.name;
    return records.fields.size() == 4 ? "" : "columns: told by their values to be" + names + " (float32)";
  } catch (const Error&) {
    return "";  // told where it is read
  }
}

/// Hands over the files one by one.
class FileReader {
 public:
  FileReader(std::vector<fs::path> files, std::vector<double> stamps)
      : files_(std::move(files)), stamps_(std::move(stamps)) {}

  std::optional<RecordedScan> operator()() {
    if (next_ == files_.size()) return std::nullopt;
    const std::size_t i = next_++;
    RecordedScan scan{i, files_[i].string(), {{stamps_[i], std::nullopt}, {}}, ""};
    try {
      scan.records.records = read_scan_file(files_[i]);
    } catch (const Error& error) {
      scan.problem = error.what();
    }
    return scan;
  }

 private:
  std::vector<fs::path> files_;
  std::vector<double> stamps_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<ScanSource> open_folder(const fs::path& path, const SourceOptions& options) {
  const auto clouds = options_of<CloudOptions>("the scan files of " + path.string(), options.values);
  const fs::path absolute = fs::absolute(path).lexically_normal();
  std::vector<fs::path> files =
      fs::is_directory(absolute) ? find_scan_files(absolute) : std::vector<fs::path>{absolute};
  ScanStamps stamps = stamps_of(files, options.rate);
  const bool kitti = is_kitti_sequence(files);
  const RecordingTraits traits{
      .nominal_stamps = stamps.nominal, .deskewed = kitti, .times = clouds.times, .unit = clouds.unit};
  std::vector<std::string> decisions{"source: " + std::to_string(files.size()) +
                                         (kitti ? " scans of a KITTI sequence in " : " scan files in ") +
                                         files.front().parent_path().string(),
                                     std::move(stamps.decision)};
  if (std::string columns = columns_sentence(files.front()); !columns.empty()) decisions.push_back(std::move(columns));
  const std::size_t count = files.size();
  return std::make_unique<RecordedSource>(FileReader(std::move(files), std::move(stamps.stamps)), traits,
                                          std::move(decisions), count);
}

}  // namespace tilth
