#include <bit>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/messages/ros_message_writer.hpp>

namespace tilth {

RosMessageWriter::RosMessageWriter(Serialization serialization) : serialization_(serialization) {
  if (serialization == Serialization::ros1) return;
  bytes_ = {std::byte(0), std::byte(1), std::byte(0), std::byte(0)};
  begin_ = bytes_.size();
}

void RosMessageWriter::unsigned_number(std::uint64_t value, std::size_t size) {
  const bool aligned = serialization_ == Serialization::cdr;
  while (aligned && (bytes_.size() - begin_) % size != 0) bytes_.push_back(std::byte(0));
  for (std::size_t i = 0; i < size; ++i) bytes_.push_back(std::byte(value >> 8 * i & 0xFF));
}

void RosMessageWriter::f64(double value) {
  unsigned_number(std::bit_cast<std::uint64_t>(value), 8);
}

void RosMessageWriter::text(std::string_view value) {
  const bool ends = serialization_ == Serialization::cdr;
  u32(value.size() + (ends ? 1 : 0));
  bytes(std::as_bytes(std::span(value)));
  if (ends) bytes_.push_back(std::byte(0));
}

void RosMessageWriter::bytes(std::span<const std::byte> value) {
  bytes_.insert(bytes_.end(), value.begin(), value.end());
}

void RosMessageWriter::time(double seconds, const std::string& field) {
  constexpr double kLimit = 4294967295.0;
  constexpr std::uint64_t kSecond = 1'000'000'000;
  if (!(seconds >= 0.0 && seconds < kLimit))
    throw Error(field, std::to_string(seconds) + " s lies outside [0, 2^32 - 1)");
  const double whole = std::floor(seconds);
  const std::uint64_t nanoseconds =
      std::uint64_t(whole) * kSecond + std::uint64_t(std::llround((seconds - whole) * 1e9));
  u32(nanoseconds / kSecond);
  u32(nanoseconds % kSecond);
}

void RosMessageWriter::header(double stamp, std::string_view frame_id, const std::string& type) {
  if (serialization_ == Serialization::ros1) u32(0);
  time(stamp, type + " header.stamp");
  text(frame_id);
}

}  // namespace tilth
