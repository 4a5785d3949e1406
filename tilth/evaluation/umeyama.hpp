// The similarity that best maps one set of points onto another: S. Umeyama, "Least-squares estimation of transformation
// parameters between two point patterns", IEEE TPAMI 13(4), 1991 (equations in the source). O(n).
#pragma once

#include <span>

#include <Eigen/Core>

namespace tilth {

/// Maps a point p to scale * rotation * p + translation.
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]
};

/// The similarity that minimises the sum of |to[i] - S from[i]|^2; of scale 1 unless `with_scale`. Throws Error where
/// the points of either set lie in one place or on one line (to within a millionth of its length): any rotation about
/// that line would do. The sets must have equal size.
Similarity umeyama(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to, bool with_scale);

}  // namespace tilth
