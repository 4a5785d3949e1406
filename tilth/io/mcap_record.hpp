// The records of an MCAP file: a byte of kind, a length, a body of little-endian numbers and strings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilth::mcap {

constexpr std::size_t kMagicSize = 8, kRecordHeader = 9;
constexpr std::uint8_t kHeader = 0x01, kFooter = 0x02, kSchema = 0x03, kChannel = 0x04, kMessage = 0x05, kChunk = 0x06,
                       kMessageIndex = 0x07, kChunkIndex = 0x08, kStatistics = 0x0B, kDataEnd = 0x0F;
constexpr std::size_t kChunkHeader = 28;    ///< [bytes] of a chunk before the name of its compression
constexpr std::size_t kMessageHeader = 22;  ///< [bytes] of a message before its data

std::span<const std::byte> magic();  ///< at both ends of a file
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

/// Puts a record together; its length is filled in by take().
class RecordWriter {
 public:
  explicit RecordWriter(std::uint8_t op) : bytes_{std::byte(op)} { number(8, 0); }

  RecordWriter& number(std::size_t size, std::uint64_t value);
  RecordWriter& text(std::string_view text);
  RecordWriter& bytes(std::span<const std::byte> bytes);
  std::vector<std::byte> take();

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace tilth::mcap
