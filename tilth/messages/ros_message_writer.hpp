// ROS messages put together field after field: ROS 1 (packed, little-endian) and CDR as ROS 2 writes it (XCDR1,
// little-endian, aligned to each number's size). The inverse of ros_message.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/messages/ros_message.hpp>

namespace tilth {

class RosMessageWriter {
 public:
  explicit RosMessageWriter(Serialization serialization);

  void u8(std::uint8_t value) { unsigned_number(value, 1); }
  void u32(std::uint64_t value) { unsigned_number(value, 4); }
  void f64(double value);
  void text(std::string_view value);
  void bytes(std::span<const std::byte> value);
  /// Throws Error, naming `field`, where it lies outside [0, 2^32) s.
  void time(double seconds, const std::string& field);
  void header(double stamp, std::string_view frame_id, const std::string& type);  ///< throws as time()

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void unsigned_number(std::uint64_t value, std::size_t size);

  Serialization serialization_;
  std::size_t begin_ = 0;  // of the message behind CDR's own header
  std::vector<std::byte> bytes_;
};

}  // namespace tilth
