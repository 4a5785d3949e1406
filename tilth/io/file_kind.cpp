#include <algorithm>
#include <cctype>

#include <tilth/io/file_kind.hpp>
#include <tilth/io/unpacked_file.hpp>

namespace tilth {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

}  // namespace

std::string kind_of_file(const std::filesystem::path& path) {
  std::filesystem::path plain = unpacked_name(path);
  if (lower_extension(plain) == ".active") plain.replace_extension();
  return lower_extension(plain);
}

bool is_hidden(const std::filesystem::path& path) {
  return path.filename().string().starts_with('.');
}

}  // namespace tilth
