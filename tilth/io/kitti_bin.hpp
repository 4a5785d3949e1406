// Scans without a header: records of little-endian float32, x y z [m] intensity as KITTI has them, and the columns that
// others add (nuScenes: ring). O(n).
#pragma once

#include <filesystem>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// Fields as bin_columns tells them. Throws Error where the file cannot be read or no number of columns makes sense.
PointRecords read_kitti_bin(const std::filesystem::path& path);
PointRecords parse_kitti_bin(std::vector<std::byte> bytes, const std::string& name);

/// Needs x y z; writes intensity 0 where there is none. Throws Error naming the missing field.
void write_kitti_bin(const std::filesystem::path& path, const PointRecords& records);

}  // namespace tilth
