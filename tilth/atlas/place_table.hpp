// places.bin and uprights.bin of a saved map: where its scans were taken and where their patches lie, and what stands
// upright. Records of fixed size, little endian.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tilth/localization/place_map.hpp>

namespace tilth {

/// A place, and the bytes of patches.bin that hold its patches.
struct PlaceRecord {
  MapPlace place;
  std::uint64_t begin = 0;     ///< [bytes]
  std::uint32_t size = 0;      ///< [bytes] packed
  std::uint32_t checksum = 0;  ///< of these
};

std::vector<std::byte> bytes_of(const std::vector<PlaceRecord>& records);

/// Throws Error naming `file`, the place and the field: no whole records, a number that is not finite, a rotation that
/// is none, patches that lie beyond `patch_bytes`.
std::vector<PlaceRecord> records_of(std::span<const std::byte> bytes, std::uint64_t patch_bytes,
                                    const std::string& file);

std::vector<std::byte> bytes_of(const std::vector<UprightCell>& cells);

/// Throws Error naming `file` where there are no whole cells, or they are not in order.
std::vector<UprightCell> cells_of(std::span<const std::byte> bytes, const std::string& file);

}  // namespace tilth
