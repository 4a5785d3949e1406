// The records of an MCAP file: a byte of kind, a length, a body of little-endian numbers and strings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tilth::mcap {

constexpr std::size_t kMagicSize = 8, kRecordHeader = 9;
constexpr std::uint8_t kSchema = 0x03, kChannel = 0x04, kMessage = 0x05, kChunk = 0x06, kDataEnd = 0x0F;
constexpr std::size_t kChunkHeader = 28;    ///< [bytes] of a chunk before the name of its compression
constexpr std::size_t kMessageHeader = 22;  ///< [bytes] of a message before its data

bool begins_file(std::span<const std::byte> bytes);

/// Takes values off the front of a body. What lies behind its end reads as 0 or "", and ok() is false from then on.
class Body {
 public:
  explicit Body(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::uint64_t number(std::size_t size);
  std::string text();
  std::span<const std::byte> bytes(std::uint64_t count);
  std::span<const std::byte> rest() const { return rest_; }
  bool ok() const { return ok_; }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

}  // namespace tilth::mcap
