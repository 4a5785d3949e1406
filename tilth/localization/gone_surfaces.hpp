// What is no longer there: surfaces of a map that later beams went through. One beam may err; beams from several places
// do not.
#pragma once

#include <cstdint>
#include <map>

#include <tilth/localization/place_check.hpp>

namespace tilth {

class GoneSurfaces {
 public:
  explicit GoneSurfaces(const PlaceCheckOptions& options) : options_(options) {}

  /// Beams that end at `patches`, in the LiDAR's frame, seen from `T_map_lidar`; `map` is in the map's frame.
  void look(const SurfacePatches& patches, const Pose& T_map_lidar, const PatchMap& map);

  /// Whether a patch, in the map's frame, lay on a surface that beams from three looks or more went through.
  bool holds(const SurfacePatch& patch_in_map) const;

 private:
  std::int64_t key_of(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  PlaceCheckOptions options_;
  int looks_ = 0;
  struct Passed {
    int looks = 0, last = 0;
  };
  std::map<std::int64_t, Passed> passed_;
};

}  // namespace tilth
