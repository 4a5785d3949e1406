// When points, or a Gaussian of them, are taken for a piece of a plane.
#pragma once

#include <Eigen/Core>

namespace tilth {

/// [m] standard deviation along the normal of a piece of a plane, at most, where no option says otherwise.
inline constexpr double kFlatThickness = 0.04;

/// Whether points of these variances [m^2], ascending, lie in a plane whose variance along the normal is `most` [m^2]
/// at most, and are three times as wide as they are thick along every direction in it.
inline bool is_flat(const Eigen::Vector3d& variances, double most) {
  constexpr double kWidth = 9;  // of variances, over the thickness
  return variances[0] <= most && variances[1] > kWidth * variances[0];
}

}  // namespace tilth
