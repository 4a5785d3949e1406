#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {
namespace {

[[noreturn]] void refuse(const std::string& name) {
  throw Error(name, "cannot be read: " + std::generic_category().message(errno));
}

struct Descriptor {
  int value;
  ~Descriptor() { ::close(value); }
};

int opened(const std::string& name) {
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) refuse(name);
  return descriptor;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()), descriptor_(opened(name_)) {
  struct stat status {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  if (known && S_ISREG(status.st_mode)) {
    size_ = std::uint64_t(status.st_size);
    return;
  }
  const int reason = known ? (S_ISDIR(status.st_mode) ? EISDIR : ESPIPE) : errno;
  ::close(descriptor_);
  errno = reason;
  refuse(name_);
}

InputFile::InputFile(std::span<const std::byte> memory, std::string name)
    : name_(std::move(name)), size_(memory.size()), memory_(memory) {}

InputFile::InputFile(InputFile&& other) noexcept
    : name_(std::move(other.name_)),
      size_(other.size_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      memory_(other.memory_) {}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::vector<std::byte> InputFile::read(std::uint64_t position, std::uint64_t count) const {
  const std::uint64_t available = position < size_ ? size_ - position : 0;
  count = std::min(count, available);
  if (descriptor_ < 0) {
    const auto from = memory_.begin() + std::ptrdiff_t(std::min(position, size_));
    return {from, from + std::ptrdiff_t(count)};
  }
  std::vector<std::byte> bytes(count);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, off_t(position + done));
    if (got < 0 && errno != EINTR) refuse(name_);
    if (got == 0) break;
    if (got > 0) done += std::size_t(got);
  }
  bytes.resize(done);
  return bytes;
}

std::vector<std::byte> read_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  const Descriptor file{opened(name)};
  std::vector<std::byte> bytes;
  struct stat status {};
  if (::fstat(file.value, &status) == 0 && S_ISREG(status.st_mode)) bytes.reserve(std::size_t(status.st_size) + 1);
  std::array<std::byte, 1 << 16> block;
  while (true) {
    const ssize_t got = ::read(file.value, block.data(), block.size());
    if (got < 0 && errno != EINTR) refuse(name);
    if (got == 0) return bytes;
    if (got > 0) bytes.insert(bytes.end(), block.begin(), block.begin() + got);
  }
}

}  // namespace tilth
