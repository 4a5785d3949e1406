// One process or thread at a time: a lock on a file, which the system takes back when its holder dies.
#pragma once

#include <filesystem>

namespace tilth::app {

enum class WhenTaken { wait, refuse };

class FileLock {
 public:
  /// Waits for the lock, or throws Error where another holds it. The file is made where it is missing and stays. Throws
  /// Error where that fails.
  explicit FileLock(const std::filesystem::path& path, WhenTaken when_taken = WhenTaken::wait);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace tilth::app
