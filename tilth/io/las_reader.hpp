// Points of LAS 1.0 to 1.4 (ASPRS, revision R15), all point formats, uncompressed: surveys, and what `write_las`
// writes. Debian has no library that reads them. O(bytes); memory is bounded by the bytes that are there, not by what
// the header claims.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// x y z [m] as double, in the frame of the file, and intensity. Points that the file withholds or calls noise (classes
/// 7 and 18) are left out. Throws Error naming file, field and bound: no LAS, compressed (LAZ), a later version, a
/// scale that is none, fewer points than stated.
PointRecords read_las(const std::filesystem::path& path);
PointRecords parse_las(std::span<const std::byte> bytes, const std::string& name);

}  // namespace tilth
