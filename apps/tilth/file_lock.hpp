// One process or thread at a time: a lock on a file, which the system takes back when its holder dies.
#pragma once

#include <filesystem>

namespace tilth::app {

class FileLock {
 public:
  /// Waits for the lock. The file is made where it is missing and stays. Throws Error where that fails.
  explicit FileLock(const std::filesystem::path& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace tilth::app
