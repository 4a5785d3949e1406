#include <algorithm>
#include <array>

#include <tilth/io/mcap_record.hpp>

namespace tilth::mcap {

std::span<const std::byte> magic() {
  static constexpr std::array<unsigned char, kMagicSize> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
  return std::as_bytes(std::span(kMagic));
}

bool begins_file(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagicSize && std::equal(magic().begin(), magic().end(), bytes.begin());
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

RecordWriter& RecordWriter::number(std::size_t size, std::uint64_t value) {
  for (std::size_t i = 0; i < size; ++i) bytes_.push_back(std::byte(value >> 8 * i & 0xFF));
  return *this;
}

RecordWriter& RecordWriter::text(std::string_view text) {
  number(4, text.size());
  return bytes(std::as_bytes(std::span(text)));
}

RecordWriter& RecordWriter::bytes(std::span<const std::byte> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return *this;
}

std::vector<std::byte> RecordWriter::take() {
  const std::uint64_t length = bytes_.size() - kRecordHeader;
  for (std::size_t i = 0; i < 8; ++i) bytes_[1 + i] = std::byte(length >> 8 * i & 0xFF);
  return std::move(bytes_);
}

}  // namespace tilth::mcap
