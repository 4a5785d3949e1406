#include <filesystem>

#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

/// The part of `text` before `separator`, which is taken out of it; all of it where there is none.
std::string take_until(std::string& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string taken = text.substr(0, end);
  text.erase(0, end == std::string::npos ? end : end + 1);
  return taken;
}

}  // namespace

SourceUri parse_source_uri(const std::string& uri) {
  std::string query = uri;
  SourceUri source{take_until(query, '?'), {}};
  while (!query.empty()) {
    std::string setting = take_until(query, '&');
    const std::string key = take_until(setting, '=');
    if (key.empty() || setting.empty()) throw Error(uri, "has a part after the question mark that is no key=value");
    source.values[key] = setting;
  }
  return source;
}

SourceUri parse_path_uri(const std::string& uri) {
  std::error_code error;
  return std::filesystem::exists(uri, error) ? SourceUri{uri, {}} : parse_source_uri(uri);
}

}  // namespace tilth
