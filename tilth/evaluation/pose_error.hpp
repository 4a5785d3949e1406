// What the difference of two poses comes to as numbers, as evo defines them. O(1) a pose.
#pragma once

#include <vector>

#include <tilth/core/se3.hpp>
#include <tilth/evaluation/metric.hpp>

namespace tilth {

struct PoseErrors {
  Metric translation;  ///< [m]
  Metric rotation;     ///< [rad] angle in [0, pi]
  Metric full;         ///< [-] Frobenius norm of E - I, E the 4x4 matrix of the difference
};

/// a^-1 b. The rotations may be short of orthonormal by the digits of a text file: they are used as they are.
Pose relative_pose(const Pose& a, const Pose& b);

/// [rad] angle of the rotation nearest to R, which is orthonormal but for the digits of a text file.
double rotation_angle(const Eigen::Matrix3d& R);

/// The errors that `differences` show. Throws Error where there are none.
PoseErrors errors_of(const std::vector<Pose>& differences);

}  // namespace tilth
