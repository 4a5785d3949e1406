#include <algorithm>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

RosMessageReader::RosMessageReader(std::span<const std::byte> message, Serialization serialization, std::string type)
    : message_(message), serialization_(serialization), type_(std::move(type)) {
  if (serialization == Serialization::ros1) return;
  constexpr std::size_t kEncapsulation = 4;
  const std::span<const std::byte> head = bytes(kEncapsulation, "encapsulation");
  const auto kind = std::to_integer<unsigned>(head[0]) << 8 | std::to_integer<unsigned>(head[1]);
  const bool first = kind <= 1, second = kind == 6 || kind == 7;
  if (!first && !second) throw Error(type_ + " encapsulation", "of kind " + std::to_string(kind) + " is no plain CDR");
  largest_alignment_ = first ? 8 : 4;
  order_ = kind % 2 == 1 ? std::endian::little : std::endian::big;
  message_ = message.subspan(kEncapsulation);
  at_ = 0;
}

std::span<const std::byte> RosMessageReader::bytes(std::size_t count, const char* field) {
  if (count > left()) {
    throw Error(type_ + " " + field,
                "needs " + std::to_string(count) + " bytes, the message has " + std::to_string(left()) + " left");
  }
  at_ += count;
  return message_.subspan(at_ - count, count);
}

std::string RosMessageReader::text(const char* field) {
  const std::span<const std::byte> raw = bytes(number<std::uint32_t>(field), field);
  std::string text(reinterpret_cast<const char*>(raw.data()), raw.size());
  if (serialization_ == Serialization::cdr && !text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

double RosMessageReader::time(const char* field) {
  const double seconds = number<std::uint32_t>(field);
  return seconds + 1e-9 * double(number<std::uint32_t>(field));
}

RosMessageReader::Header RosMessageReader::header() {
  if (serialization_ == Serialization::ros1) number<std::uint32_t>("header.seq");
  Header header;
  header.stamp = time("header.stamp");
  header.frame_id = text("header.frame_id");
  return header;
}

std::uint64_t RosMessageReader::unsigned_number(std::size_t size, const char* field) {
  align(size);
  const std::span<const std::byte> raw = bytes(size, field);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t at = order_ == std::endian::little ? size - 1 - i : i;
    value = value << 8 | std::to_integer<std::uint64_t>(raw[at]);
  }
  return value;
}

void RosMessageReader::align(std::size_t size) {
  const std::size_t alignment = std::min(size, largest_alignment_);
  at_ = std::min((at_ + alignment - 1) / alignment * alignment, message_.size());
}

}  // namespace tilth
