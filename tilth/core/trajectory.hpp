// Poses over time.
#pragma once

#include <vector>

#include <tilth/core/se3.hpp>

namespace tilth {

struct StampedPose {
  double stamp = 0.0;  ///< [s]
  Pose T_world_lidar = Pose::Identity();
};

using Trajectory = std::vector<StampedPose>;  ///< stamps ascending

/// The pose at `stamp`, on the screw motion between its two neighbours; before the first and after the last pose it is
/// extrapolated from the nearest pair. Throws Error on an empty trajectory. O(log n).
Pose interpolate(const Trajectory& trajectory, double stamp);

/// [m] sum of the distances between consecutive poses.
double path_length(const Trajectory& trajectory);

}  // namespace tilth
