// Bytes under a path, for readers that take no memory: a file that lives as long as this.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace tilth::fuzz {

class TemporaryFile {
 public:
  explicit TemporaryFile(std::span<const std::byte> bytes)
      : path_((std::filesystem::temp_directory_path() / "tilth-fuzz-XXXXXX").string()) {
    const int descriptor = ::mkstemp(path_.data());
    const bool written = descriptor >= 0 && ::write(descriptor, bytes.data(), bytes.size()) == ssize_t(bytes.size());
    ::close(descriptor);
    if (!written) throw std::runtime_error("no temporary file " + path_);
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace tilth::fuzz
