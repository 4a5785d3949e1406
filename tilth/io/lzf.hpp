// LZF (M. Lehmann's liblzf format), the compression inside PCD files: literal runs and back references. O(output).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tilth {

/// Exactly `size` bytes out of `compressed`; nothing where the data breaks off, points before its begin, or yields
/// another size. Never holds more than 88 times the compressed bytes, the most that the format can yield.
std::optional<std::vector<std::byte>> lzf_decompress(std::span<const std::byte> compressed, std::size_t size);

}  // namespace tilth
