// KITTI velodyne scans: records of four little-endian float32 x y z [m] intensity, without a header. O(n).
#pragma once

#include <filesystem>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// Fields x y z intensity. Throws Error where the file cannot be read or does not hold whole records of 16 bytes.
PointRecords read_kitti_bin(const std::filesystem::path& path);
PointRecords parse_kitti_bin(std::vector<std::byte> bytes, const std::string& name);

/// Needs x y z; writes intensity 0 where there is none. Throws Error naming the missing field.
void write_kitti_bin(const std::filesystem::path& path, const PointRecords& records);

}  // namespace tilth
