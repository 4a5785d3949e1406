// The names of a saved map's files, and map.yaml, which lists them with their sizes and checksums.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include <tilth/core/options.hpp>

namespace tilth {

inline constexpr const char* kMapList = "map.yaml";
inline constexpr const char* kMapPlaces = "places.bin";
inline constexpr const char* kMapUprights = "uprights.bin";
inline constexpr const char* kMapPatches = "patches.bin";
inline constexpr const char* kMapGraph = "pose_graph.g2o";
inline constexpr const char* kMapBeams = "beams.yaml";

struct ListedFile {
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;  ///< 0 for patches.bin, whose parts have their own
};

/// What map.yaml says.
struct MapList {
  int format = 0;
  std::string program, source;
  std::uint64_t places = 0;
  std::map<std::string, ListedFile> files = {};
};

std::string text_of(const MapList& list);

/// Throws Error naming `name`, key and bound.
MapList parse_map_list(const std::string& text, const std::string& name);

}  // namespace tilth
