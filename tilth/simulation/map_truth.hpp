// A map against the scene that it was made of: how far its points lie from the true surfaces, and how much of what the
// sensor could see is in it.
#pragma once

#include <span>

#include <tilth/core/options.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/simulation/mesh_world.hpp>

namespace tilth {

struct MapTruthOptions {
  double spacing = 0.1;
  double reach = 0.1;
  double max_range = 30.0;
  double lowest = -15.0;
  double highest = 15.0;
};

template <class V>
void visit(MapTruthOptions& o, V&& v) {
  v("spacing", o.spacing, Bounds{0.005, 100},
    "[m] between the points of the true surface that are looked for in the map");
  v("reach", o.reach, Bounds{1e-4, 100},
    "[m] within which a point of the map counts as on a surface, and a surface as mapped");
  v("max_range", o.max_range, Bounds{0.1, 1e4}, "[m] up to which a surface counts as seen");
  v("lowest", o.lowest, Bounds{-90, 90}, "[deg] elevation of the sensor's lowest beam");
  v("highest", o.highest, Bounds{-90, 90}, "[deg] of its highest beam");
}

struct MapTruth {
  std::size_t points = 0;                                             ///< of the map
  double mean = 0.0, median = 0.0, rmse = 0.0, p95 = 0.0, max = 0.0;  ///< [m] distance of a point to the true surface
  double on_surface = 0.0;                                            ///< [-] share of the points within reach of it
  double rmse_on_surface = 0.0;                                       ///< [m] of those
  std::size_t seen = 0;       ///< points of the true surface that the sensor could see
  double completeness = 0.0;  ///< [-] share of these with a point of the map within reach; 0 where nothing was seen
};

/// `points` [m] of the map and `poses` of the LiDAR, both in the frame of the mesh. Throws Error where the map is
/// empty.
MapTruth judge_map(std::span<const Eigen::Vector3d> points, const MeshWorld& world, std::span<const Pose> poses,
                   const MapTruthOptions& options);

}  // namespace tilth
