// Bytes of a file, or of memory in its place (tests, fuzzing): read at a position, never more than there are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilth {

class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);           ///< throws Error with the system's reason
  InputFile(std::span<const std::byte> memory, std::string name);  ///< `memory` must outlive this
  ~InputFile();
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }

  /// `count` bytes from `position`; fewer where the file ends before. Throws Error where the system cannot read.
  std::vector<std::byte> read(std::uint64_t position, std::uint64_t count) const;

 private:
  std::string name_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;  ///< -1: the bytes are in memory_
  std::span<const std::byte> memory_;
};

/// The whole file. Throws Error naming the path and the system's reason.
std::vector<std::byte> read_file(const std::filesystem::path& path);

inline std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace tilth
