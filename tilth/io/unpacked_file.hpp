// A file, or what is in it where it was packed as a whole (ROS 2's compression mode FILE: .db3.zstd, .mcap.zstd).
#pragma once

#include <filesystem>
#include <string>

namespace tilth {

/// The name of the file when it is unpacked: without ".zstd" or ".zst".
std::filesystem::path unpacked_name(const std::filesystem::path& path);

class UnpackedFile {
 public:
  /// Unpacks into the temporary folder of the system, as far as the file is whole. Throws Error where it cannot be
  /// read, is packed otherwise, or there is no room.
  explicit UnpackedFile(const std::filesystem::path& path);
  ~UnpackedFile();  ///< the copy is removed
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }  ///< of the file itself, or of the copy

 private:
  std::filesystem::path path_;
  bool copy_ = false;
};

}  // namespace tilth
