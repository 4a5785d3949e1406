// Where a raw recording of KITTI has its scans and their times: DRIVE/velodyne_points/data/*.bin, timestamps.txt.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <tilth/sources/scan_files.hpp>

namespace tilth {

/// The folder of the scans, from that of the drive, the one above with this drive alone, or velodyne_points itself.
std::optional<std::filesystem::path> kitti_raw_scans(const std::filesystem::path& folder);

/// Stamps by the numbers in the names of `files`, of which some may be missing, where timestamps.txt lies in the folder
/// above; nothing where it does not. Throws Error where a line of it is no date, or it has none for a file.
std::optional<ScanStamps> kitti_raw_stamps(const std::vector<std::filesystem::path>& files);

}  // namespace tilth
