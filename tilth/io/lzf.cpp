#include <tilth/io/lzf.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMaxGrowth = 88;  // 264 bytes from a back reference of 3

struct Decoder {
  std::span<const std::byte> in;
  std::vector<std::byte> out;
  std::size_t size;
  std::size_t at = 0;

  bool copy_literals(std::size_t count) {
    if (count > in.size() - at || count > size - out.size()) return false;
    out.insert(out.end(), in.begin() + std::ptrdiff_t(at), in.begin() + std::ptrdiff_t(at + count));
    at += count;
    return true;
  }

  bool copy_reference(unsigned control) {
    std::size_t count = (control >> 5) + 2;
    if (count == 9 && at < in.size()) count += std::to_integer<std::size_t>(in[at++]);
    if (at >= in.size()) return false;
    const std::size_t distance = ((control & 0x1fU) << 8) + std::to_integer<std::size_t>(in[at++]) + 1;
    if (distance > out.size() || count > size - out.size()) return false;
    for (std::size_t i = 0; i < count; ++i) out.push_back(out[out.size() - distance]);
    return true;
  }
};

}  // namespace

std::optional<std::vector<std::byte>> lzf_decompress(std::span<const std::byte> compressed, std::size_t size) {
  if (size / kMaxGrowth > compressed.size()) return std::nullopt;
  Decoder decoder{compressed, {}, size};
  decoder.out.reserve(size);
  while (decoder.at < compressed.size()) {
    const unsigned control = std::to_integer<unsigned>(compressed[decoder.at++]);
    if (!(control < 32 ? decoder.copy_literals(control + 1) : decoder.copy_reference(control))) return std::nullopt;
  }
  if (decoder.out.size() != size) return std::nullopt;
  return std::move(decoder.out);
}

}  // namespace tilth
