// Poses that are tied to one another by measured motions: what loop closure optimises, and what g2o files hold.
#pragma once

#include <cstddef>
#include <vector>

#include <tilth/core/se3.hpp>

namespace tilth {

/// A measured motion between two poses of a graph; its error is log(T_from_to^-1 * T_world_from^-1 * T_world_to).
struct Constraint {
  std::size_t from = 0, to = 0;  ///< numbers of poses
  Pose T_from_to = Pose::Identity();
  Matrix6d information = Matrix6d::Identity();  ///< [1/rad^2, 1/m^2] of the error: rotation first, in the frame of `to`
  bool closure = false;                         ///< joins places seen at different times, and may be wrong
};

struct PoseGraph {
  std::vector<Pose> poses = {};  ///< T_world_lidar
  std::vector<Constraint> constraints = {};
};

}  // namespace tilth
