#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include <tilth/core/error.hpp>
#include <tilth/io/append_file.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {

AppendFile::AppendFile(const std::filesystem::path& path, bool anew) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (anew ? O_TRUNC : 0), 0666);
  if (descriptor_ < 0) refuse();
  empty_ = ::lseek(descriptor_, 0, SEEK_END) == 0;
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendFile::write_line(std::string_view line) {
  while (!line.empty()) {
    const ssize_t done = ::write(descriptor_, line.data(), line.size());
    if (done < 0 && errno != EINTR) refuse();
    if (done > 0) line.remove_prefix(std::size_t(done));
  }
  empty_ = false;
}

void AppendFile::refuse() const {
  throw Error(path_.string(), "cannot be written: " + std::generic_category().message(errno));
}

std::size_t keep_whole_lines(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return 0;
  const std::vector<std::byte> bytes = read_file(path);
  const std::string_view text = as_text(bytes);
  const std::size_t end = text.rfind('\n');
  const std::size_t whole = end == std::string_view::npos ? 0 : end + 1;
  if (whole < text.size()) {
    std::error_code error;
    std::filesystem::resize_file(path, whole, error);
    if (error) throw Error(path.string(), "cannot be mended: " + error.message());
  }
  return std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(whole), '\n'));
}

}  // namespace tilth
