#include <filesystem>

#include <tilth/core/error.hpp>
#include <tilth/sources/bag_source.hpp>
#include <tilth/sources/folder_source.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/sources/scan_files.hpp>
#include <tilth/sources/simulated_source.hpp>

namespace tilth {

std::unique_ptr<ScanSource> open_source(const std::string& uri, const SourceOptions& options) {
  if (uri.starts_with(kSimulatedScheme)) return open_simulation(uri);
  const std::filesystem::path path(uri);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw Error(uri, "no such file or folder");
  if (std::filesystem::is_directory(status) || is_scan_file(path)) return open_folder(path, options);
  if (path.extension() == ".bag") return open_bag(path, options);
  throw Error(uri, "is no folder of scans, .pcd, .ply, .bin or .bag");
}

}  // namespace tilth
