// A map as localisation sees it: the places that it was made from, what stands upright in all of it, and the patches of
// one place at a time, which may lie on a disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tilth/core/surface_patch.hpp>
#include <tilth/localization/upright_cells.hpp>

namespace tilth {

/// Where a scan of the map was taken.
struct MapPlace {
  double stamp = 0.0;                          ///< [s] of the run that made the map
  Pose T_map_lidar = Pose::Identity();         ///< as loop closure left it
  Matrix6d covariance = Matrix6d::Identity();  ///< [rad^2, m^2] of the motion since the place before
  std::uint32_t patches = 0;                   ///< how many it has; none where later places have taken its place
};

class PlaceMap {
 public:
  virtual ~PlaceMap() = default;

  virtual const std::vector<MapPlace>& places() const = 0;
  virtual const std::vector<UprightCell>& uprights() const = 0;

  /// Of a place, in its LiDAR's frame. Throws Error where they cannot be read.
  virtual SurfacePatches patches(std::size_t place) const = 0;
};

}  // namespace tilth
