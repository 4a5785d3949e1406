#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/sources/folder_source.hpp>
#include <tilth/sources/recorded_source.hpp>
#include <tilth/sources/scan_files.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

PointRecords read_scan_file(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (extension == ".pcd") return read_pcd(path);
  if (extension == ".ply") return read_ply(path);
  return read_kitti_bin(path);
}

/// A KITTI odometry sequence: its folder was opened, or the velodyne/ in it.
bool is_kitti_sequence(const std::vector<fs::path>& files) {
  const fs::path folder = files.front().parent_path();
  const bool bins = std::all_of(files.begin(), files.end(), [](const fs::path& f) { return f.extension() == ".bin"; });
  return bins && folder.filename() == "velodyne" && fs::is_regular_file(folder.parent_path() / "calib.txt");
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
  const RecordingTraits traits{stamps.nominal, kitti, clouds.times};
  std::vector<std::string> decisions{"source: " + std::to_string(files.size()) +
                                         (kitti ? " scans of a KITTI sequence in " : " scan files in ") +
                                         files.front().parent_path().string(),
                                     std::move(stamps.decision)};
  const std::size_t count = files.size();
  return std::make_unique<RecordedSource>(FileReader(std::move(files), std::move(stamps.stamps)), traits,
                                          std::move(decisions), count);
}

}  // namespace tilth
