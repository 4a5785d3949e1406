#include <liblzf/lzf.h>
#include <limits>

#include <tilth/io/lzf.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMaxGrowth = 88;                               // 264 bytes from a back reference of 3
constexpr std::size_t kMost = std::numeric_limits<unsigned>::max();  // liblzf counts in these

}  // namespace

std::optional<std::vector<std::byte>> lzf_decompress(std::span<const std::byte> compressed, std::size_t size) {
  if (compressed.empty() && size == 0) return std::vector<std::byte>();
  if (compressed.empty() || size == 0) return std::nullopt;  // liblzf reads a byte before it looks
  if (size / kMaxGrowth > compressed.size() || size > kMost || compressed.size() > kMost) return std::nullopt;
  std::vector<std::byte> out(size);
  const unsigned written = ::lzf_decompress(compressed.data(), unsigned(compressed.size()), out.data(), unsigned(size));
  if (written != size) return std::nullopt;
  return out;
}

}  // namespace tilth
