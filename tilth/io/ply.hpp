// PLY (Stanford polygon files): the vertices of ascii and binary files of both byte orders; other elements, with or
// without lists, are skipped. O(bytes); memory is bounded by the bytes that are there, not by what the header claims.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// Every property of the element "vertex". NaN and infinite values pass. Throws Error naming file, property and bound:
/// no vertex element, a list among its properties, fewer vertices than stated.
PointRecords read_ply(const std::filesystem::path& path);
PointRecords parse_ply(std::span<const std::byte> bytes, const std::string& name);

/// binary_little_endian 1.0, all fields. Throws Error for a 64-bit integer field, which PLY does not have.
void write_ply(const std::filesystem::path& path, const PointRecords& records);

}  // namespace tilth
