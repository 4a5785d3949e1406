// Serialised ROS messages, field after field: ROS 1 (packed, little-endian) and CDR as ROS 2 writes it (OMG XTypes
// XCDR1 and 2: aligned to each number's size, either byte order, strings with their NUL).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace tilth {

enum class Serialization : std::uint8_t { ros1, cdr };

class RosMessageReader {
 public:
  /// `type` is named in errors. Throws Error where CDR's own header is cut or of an unknown kind.
  RosMessageReader(std::span<const std::byte> message, Serialization serialization, std::string type);

  /// Each throws Error naming `field` where the message ends before.
  std::span<const std::byte> bytes(std::size_t count, const char* field);
  std::string text(const char* field);
  template <class T>
  T number(const char* field) {
    return T(unsigned_number(sizeof(T), field));
  }

  double time(const char* field);  ///< [s]
  struct Header {
    double stamp = 0.0;  ///< [s]
    std::string frame_id;
  };
  Header header();

  std::size_t left() const { return message_.size() - at_; }  ///< [bytes]
  Serialization serialization() const { return serialization_; }

 private:
  std::uint64_t unsigned_number(std::size_t size, const char* field);
  void align(std::size_t size);

  std::span<const std::byte> message_;  // without CDR's own header
  Serialization serialization_;
  std::string type_;
  std::size_t at_ = 0, largest_alignment_ = 1;
  std::endian order_ = std::endian::little;
};

}  // namespace tilth
