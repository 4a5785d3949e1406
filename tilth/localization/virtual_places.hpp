// A bare cloud as a map: places are put all over its free ground, and each gets the patches of surface that a LiDAR
// there would see. O(points + places x patches within range).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/localization/place_map.hpp>

namespace tilth {

struct VirtualPlaceOptions {
  double height = 0.8;
  double step = 2.0;
  double cell = 0.3;
  int min_points = 4;
  double range = 30.0;
  int max_patches = 1200;
};

template <class V>
void visit(VirtualPlaceOptions& o, V&& v) {
  v("height", o.height, Bounds{0.1, 10}, "[m] of the LiDAR above the ground, about");
  v("step", o.step, Bounds{0.5, 100}, "[m] of cells of the plane, each of which gets a place where it has free ground");
  v("cell", o.cell, Bounds{0.05, 5}, "[m] of the voxels whose points become a patch");
  v("min_points", o.min_points, Bounds{3, 1e6}, "[points] of a patch, at least");
  v("range", o.range, Bounds{1, 1000}, "[m] that a place sees");
  v("max_patches", o.max_patches, Bounds{50, 1e6}, "[patches] of a place, at most");
}

struct VirtualPlace {
  Pose T_map_lidar = Pose::Identity();
  SurfacePatches patches = {};  ///< in the LiDAR's frame
};

/// `points` in the map's frame, z up; those that are not finite are passed over. Of several floors the lowest is taken.
/// Throws Error where there is no free ground. `take` gets one place after another.
void make_virtual_places(std::span<const Eigen::Vector3d> points, const VirtualPlaceOptions& options,
                         const std::function<void(const VirtualPlace&)>& take);

}  // namespace tilth
