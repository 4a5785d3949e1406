// A saved map: a folder of places with their patches, the pose graph that laid them, what stands upright in it, the
// errors of the sensor's beams, and checksums of all that. It is opened in parts: patches are read when they are asked
// for. docs/localization.md describes every file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <tilth/atlas/place_table.hpp>
#include <tilth/core/beam_estimate.hpp>
#include <tilth/core/pose_graph.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {

inline constexpr int kMapFormat = 1;

/// Where a map comes from.
struct MapOrigin {
  std::string program;  ///< version that wrote it
  std::string source;   ///< recording, or cloud, that it was made of
};

class MapFolder final : public PlaceMap {
 public:
  /// Throws Error naming file, field and bound where the folder is no map, is damaged, or is of a later format.
  explicit MapFolder(const std::filesystem::path& folder);

  const std::vector<MapPlace>& places() const override { return places_; }
  const std::vector<UprightCell>& uprights() const override { return uprights_; }
  SurfacePatches patches(std::size_t place) const override;

  const MapOrigin& origin() const { return origin_; }
  PoseGraph graph() const;                        ///< of the places
  std::optional<BeamEstimate> beams() const;      ///< that its scans were corrected by
  std::uint64_t bytes() const { return bytes_; }  ///< of all files

 private:
  std::filesystem::path folder_;
  MapOrigin origin_;
  std::vector<MapPlace> places_;
  std::vector<PlaceRecord> records_;
  std::vector<UprightCell> uprights_;
  std::uint64_t bytes_ = 0;
  std::unique_ptr<InputFile> patches_;
};

/// Whether the folder holds a map, whole or damaged.
bool holds_map(const std::filesystem::path& folder);

}  // namespace tilth
