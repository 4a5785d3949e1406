// Where a scan may lie in a map, from far off: correlative matching (Olson 2009) of what stands upright, seen from
// above on a grid with a layer for each way that surfaces face. About 10 ms for 5 m and 30 degrees to either side.
#pragma once

#include <span>
#include <vector>

#include <tilth/core/se3.hpp>

namespace tilth {

/// A point of a surface, and the way it faces; up is z.
struct FacingPoint {
  Eigen::Vector3d point, normal;
};

/// How far about the start.
struct SearchWindow {
  double radius = 0.0;  ///< [m] to each side
  double yaw = 0.0;     ///< [rad] to each side
};

struct PoseSearchOptions {
  double cell = 0.5;        ///< [m]
  double yaw_step = 0.05;   ///< [rad]
  double range = 40.0;      ///< [m] points farther from the sensor are left out
  int max_points = 300;     ///< of the source
  int max_candidates = 12;  ///< that are given
};

struct PoseCandidate {
  Pose T_target_source = Pose::Identity();
  double score = 0.0;  ///< [-] of the best that could be, in [0, 1]
};

/// The best poses about `T_start`, best first, each the best of those around it; roll, pitch and height stay. Empty
/// where nothing in the source stands upright. O(points x cells x yaws) of the window.
std::vector<PoseCandidate> search_poses(std::span<const FacingPoint> target, std::span<const FacingPoint> source,
                                        const Pose& T_start, const SearchWindow& window,
                                        const PoseSearchOptions& options);

}  // namespace tilth
