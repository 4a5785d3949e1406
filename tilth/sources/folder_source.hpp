// A folder of .pcd, .ply or .bin scans, a KITTI odometry sequence, or one such file.
#pragma once

#include <filesystem>
#include <memory>

#include <tilth/sources/open_source.hpp>

namespace tilth {

/// Scans of `path` in natural order; a KITTI sequence (velodyne/*.bin with calib.txt) counts as deskewed. Files that
/// cannot be read are passed over. Throws Error where there are no scans, or none can be read.
std::unique_ptr<ScanSource> open_folder(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace tilth
