// Writes a saved map, place by place, into a folder beside its own, which takes its name when all of it is on the disk:
// whoever is killed meanwhile leaves the old map whole. Memory: the list of places.
#pragma once

#include <filesystem>
#include <optional>

#include <tilth/atlas/map_folder.hpp>
#include <tilth/io/output_file.hpp>

namespace tilth {

class MapWriter {
 public:
  /// Throws Error where the folder cannot be made, or something else than a map stands under its name.
  explicit MapWriter(const std::filesystem::path& folder);
  ~MapWriter();  ///< without finish() before, what was written is removed and the old map stays
  MapWriter(const MapWriter&) = delete;
  MapWriter& operator=(const MapWriter&) = delete;

  /// The next place.
  void add(const MapPlace& place, const SurfacePatches& patches);

  /// Puts the map in its place. `graph` is that of the places. Throws Error where there are none, or the disk is full.
  void finish(const MapOrigin& origin, const PoseGraph& graph, const std::optional<BeamEstimate>& beams);

 private:
  std::filesystem::path folder_, partial_;
  std::optional<OutputFile> patches_;
  std::vector<PlaceRecord> records_;
  UprightGatherer uprights_;
  bool finished_ = false;
};

}  // namespace tilth
