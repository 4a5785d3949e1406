// Compressed bytes of recordings: frames of LZ4 and Zstandard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tilth {

constexpr std::uint64_t kMostUnpacked = std::uint64_t{1} << 28;  ///< [bytes] of one frame: more is taken for damage

/// The bytes in `packed`; `compression` is "lz4", "zstd" or "". Nothing where they are damaged, compressed otherwise,
/// or more than kMostUnpacked. Memory grows with what is unpacked, whatever sizes the data claims.
std::optional<std::vector<std::byte>> unpack(std::string_view compression, std::span<const std::byte> packed);

/// `plain` as one frame of Zstandard.
std::vector<std::byte> pack_zstd(std::span<const std::byte> plain);

}  // namespace tilth
