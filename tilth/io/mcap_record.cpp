#include <algorithm>
#include <array>

#include <tilth/io/mcap_record.hpp>

namespace tilth::mcap {

bool begins_file(std::span<const std::byte> bytes) {
  constexpr std::array<unsigned char, kMagicSize> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
  return bytes.size() >= kMagicSize &&
         std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                    [](unsigned char a, std::byte b) { return a == std::to_integer<unsigned char>(b); });
}

std::uint64_t Body::number(std::size_t size) {
  const std::span<const std::byte> raw = bytes(size);
  std::uint64_t value = 0;
  for (std::size_t i = raw.size(); i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(raw[i]);
  return value;
}

std::string Body::text() {
  const std::span<const std::byte> raw = bytes(number(4));
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

std::span<const std::byte> Body::bytes(std::uint64_t count) {
  ok_ = ok_ && count <= rest_.size();
  if (!ok_) return {};
  const std::span<const std::byte> taken = rest_.first(std::size_t(count));
  rest_ = rest_.subspan(std::size_t(count));
  return taken;
}

}  // namespace tilth::mcap
