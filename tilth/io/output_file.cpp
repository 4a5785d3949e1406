#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>

namespace tilth {
namespace {

std::filesystem::path place_of(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  const bool in_place = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  return in_place ? path : std::filesystem::path(path.string() + ".partial");
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path), partial_(place_of(path)) {
  descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) refuse();
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      partial_(std::move(other.partial_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (partial_ != path_) ::unlink(partial_.c_str());
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
    if (done < 0 && errno != EINTR) refuse();
    if (done <= 0) continue;
    bytes = bytes.subspan(std::size_t(done));
    size_ += std::uint64_t(done);
  }
}

void OutputFile::write_at(std::uint64_t position, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), off_t(position));
    if (done < 0 && errno != EINTR) refuse();
    if (done <= 0) continue;
    bytes = bytes.subspan(std::size_t(done));
    position += std::uint64_t(done);
  }
}

void OutputFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  const bool closed = ::close(descriptor) == 0;
  if (closed && (partial_ == path_ || ::rename(partial_.c_str(), path_.c_str()) == 0)) return;
  const int reason = errno;
  if (partial_ != path_) ::unlink(partial_.c_str());
  errno = reason;
  refuse();
}

void OutputFile::refuse() const {
  throw Error(path_.string(), "cannot be written: " + std::generic_category().message(errno));
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

}  // namespace tilth
