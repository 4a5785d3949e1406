#include <array>
#include <sstream>

#include <tilth/core/error.hpp>
#include <tilth/run/output_options.hpp>

namespace tilth {

std::optional<UtmOrigin> origin_of(const OutputOptions& options) {
  if (options.origin.empty()) return std::nullopt;
  if (!map_formats(options).contains("las"))
    throw Error("option origin", "is that of a map as LAS, and none is written: expected map_format=las beside it");
  return parse_utm_origin(options.origin);
}

std::set<std::string> map_formats(const OutputOptions& options) {
  const std::set<std::string> known{"pcd", "ply", "las", "bt", "tiles"};
  std::set<std::string> formats;
  std::istringstream words(options.map_format);
  for (std::string word; std::getline(words, word, ',');) {
    if (!known.contains(word))
      throw Error("option map_format", "has '" + word + "': expected pcd, ply, las, bt or tiles");
    formats.insert(word);
  }
  if (formats.empty()) throw Error("option map_format", "names no format: expected pcd, ply, las, bt or tiles");
  return formats;
}

}  // namespace tilth
