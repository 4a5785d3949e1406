// A file that is written completely or not at all: bytes go to "<name>.partial", which takes the name on close().
// Devices and pipes are written in place. Every failure throws Error with the path and the system's reason (disk full).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tilth {

class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();  ///< without close() before, the partial file is removed and the old file stays
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  void write_at(std::uint64_t position, std::span<const std::byte> bytes);  ///< over bytes written before
  std::uint64_t size() const { return size_; }                              ///< [bytes] written so far
  void close();                                                             ///< makes the file appear under its name

 private:
  [[noreturn]] void refuse() const;

  std::filesystem::path path_, partial_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Writes `text` as the whole file.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace tilth
