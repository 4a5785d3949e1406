// Scans into files: one file a scan in a folder, or all in one recording as sensor_msgs/PointCloud2.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/scan.hpp>

namespace tilth::app {

enum class CloudFile { pcd, ply, las, kitti };

/// Throws Error listing the formats.
CloudFile cloud_file(std::string_view name);

/// What it captures it owns.
struct ScanWriter {
  std::function<void(std::size_t index, const Scan& scan)> write;  ///< in the order of time
  std::function<void()> close;                                     ///< only then does a recording stand under its name
};

/// The folder in `folder` where scans of that format lie: scans, or KITTI's velodyne.
std::filesystem::path scan_folder(const std::filesystem::path& folder, CloudFile format);

/// Makes `folder` and scan_folder(). Throws Error where that fails.
ScanWriter scans_in_folder(const std::filesystem::path& folder, CloudFile format);

ScanWriter scans_in_bag(const std::filesystem::path& path);   ///< ROS 1
ScanWriter scans_in_mcap(const std::filesystem::path& path);  ///< ROS 2

/// One number [s] a line, as `tilth run` reads it beside the scans.
void write_times(const std::filesystem::path& path, const std::vector<double>& stamps);

/// Throws Error with the system's reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace tilth::app
