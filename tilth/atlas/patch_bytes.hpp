// The patches of a place as bytes, field by field, and back: 57 bytes a patch before they are packed. What a file of a
// map holds of them is bounded by the bytes that are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/surface_patch.hpp>

namespace tilth {

/// Little endian, to the precision of float; when each was seen within its scan is left out.
std::vector<std::byte> bytes_of(const SurfacePatches& patches);

/// Throws Error naming `where` where there are no whole patches, or one has a value that none can have.
SurfacePatches patches_of(std::span<const std::byte> bytes, const std::string& where);

/// The CRC-32 of zlib and PNG.
std::uint32_t checksum(std::span<const std::byte> bytes);

}  // namespace tilth
