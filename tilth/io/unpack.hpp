// Compressed bytes of recordings: frames of LZ4 and Zstandard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <tilth/io/input_file.hpp>

namespace tilth {

constexpr std::uint64_t kMostUnpacked = std::uint64_t{1} << 28;  ///< [bytes] of one frame: more is taken for damage

/// Whether the bytes begin as a Zstandard frame.
bool is_zstd(std::span<const std::byte> bytes);

/// The bytes in `packed`; `compression` is "lz4", "zstd" or "". Nothing where they are damaged, compressed otherwise,
/// or more than kMostUnpacked. Memory grows with what is unpacked, whatever sizes the data claims.
std::optional<std::vector<std::byte>> unpack(std::string_view compression, std::span<const std::byte> packed);

/// Hands what is in `packed`, one or more frames of Zstandard, piece by piece to `take`; false where it is damaged or
/// breaks off. Memory: a piece, and the window that the frame asks for (128 MiB at most).
bool unpack_zstd_file(const InputFile& packed, const std::function<void(std::span<const std::byte>)>& take);

/// `plain` as one frame of Zstandard.
std::vector<std::byte> pack_zstd(std::span<const std::byte> plain);

}  // namespace tilth
