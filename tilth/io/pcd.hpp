// PCD, the point cloud files of PCL, versions 0.5 to 0.7: ascii, binary and binary_compressed (LZF). O(bytes); memory
// is bounded by the bytes that are there, not by what the header claims.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// Every field but "_" padding; of fields with COUNT > 1 the first element. NaN and infinite values pass. Throws Error
/// naming file, field and bound where the header contradicts itself or the file holds fewer points than it states.
PointRecords read_pcd(const std::filesystem::path& path);
PointRecords parse_pcd(std::span<const std::byte> bytes, const std::string& name);

/// Version 0.7, DATA binary, all fields.
void write_pcd(const std::filesystem::path& path, const PointRecords& records);

}  // namespace tilth
