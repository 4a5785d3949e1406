#include <cstdlib>
#include <system_error>
#include <unistd.h>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/unpack.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

bool is_packed(const fs::path& path) {
  return path.extension() == ".zstd" || path.extension() == ".zst";
}

/// A new file of no bytes.
std::string temporary_file() {
  std::string name = (fs::temp_directory_path() / "tilth-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) throw Error(name, "cannot be made: " + std::generic_category().message(errno));
  ::close(descriptor);
  return name;
}

}  // namespace

fs::path unpacked_name(const fs::path& path) {
  return is_packed(path) ? fs::path(path).replace_extension() : path;
}

UnpackedFile::UnpackedFile(const fs::path& path) : path_(path), copy_(is_packed(path)) {
  if (!copy_) return;
  const InputFile packed(path);
  path_ = temporary_file();
  try {
    OutputFile plain(path_);
    if (!unpack_zstd_file(packed, [&](std::span<const std::byte> bytes) { plain.write(bytes); }) && plain.size() == 0)
      throw Error(path.string(), "is no file packed by Zstandard");
    plain.close();
  } catch (...) {
    ::unlink(path_.c_str());
    throw;
  }
}

UnpackedFile::~UnpackedFile() {
  if (copy_) ::unlink(path_.c_str());
}

}  // namespace tilth
