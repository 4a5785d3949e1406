// Payloads of LiDAR packets one after the other, 1206 or 1212 bytes each, and nothing else: as drivers and
// demonstrations store them. A payload is known by the twelve flags FF EE of its blocks, so damage costs only what it
// hits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tilth/io/input_file.hpp>

namespace tilth {

class PayloadFileReader {
 public:
  explicit PayloadFileReader(InputFile file) : file_(std::move(file)) {}

  std::optional<std::vector<std::byte>> next();       ///< nothing at the end
  std::uint64_t skipped() const { return skipped_; }  ///< [bytes] that belong to no payload

 private:
  std::span<const std::byte> window() const { return std::span(bytes_).subspan(at_); }
  bool fill();
  void resynchronise();

  InputFile file_;
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0, size_ = 1206;
  std::uint64_t position_ = 0, skipped_ = 0;
};

/// The file begins with a payload.
bool is_payload_file(const std::filesystem::path& path);

}  // namespace tilth
