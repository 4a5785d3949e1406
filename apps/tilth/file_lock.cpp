#include "file_lock.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <tilth/core/error.hpp>

namespace tilth::app {

FileLock::FileLock(const std::filesystem::path& path, WhenTaken when_taken)
    : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) throw Error(path.string(), std::strerror(errno));
  int locked = -1;
  do locked = ::flock(descriptor_, when_taken == WhenTaken::wait ? LOCK_EX : LOCK_EX | LOCK_NB);
  while (locked < 0 && errno == EINTR);
  if (locked == 0) return;
  const int reason = errno;
  ::close(descriptor_);
  if (reason == EWOULDBLOCK) throw Error(path.string(), "is locked: another tilth is writing into this folder");
  throw Error(path.string(), std::string("cannot be locked: ") + std::strerror(reason));
}

FileLock::~FileLock() {
  ::close(descriptor_);
}

}  // namespace tilth::app
