// The normal equations of Gauss-Newton for a scan in motion: what pairs of patches say about its pose and velocity.
// O(pairs).
#pragma once

#include <array>

#include <tilth/registration/align.hpp>
#include <tilth/registration/patch_pairs.hpp>

namespace tilth {

using Vector12d = Eigen::Matrix<double, 12, 1>;  ///< tangent of the pose, then change of the velocity
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Of the pairs, and then of the priors added to it: H x = -b.
struct ContinuousTimeSystem {
  LinearSystem pose;  ///< of the pose alone
  Matrix12d H = Matrix12d::Zero();
  Vector12d b = Vector12d::Zero();
};

/// What each part of a scan says (docs/method.md, 14), between two knots of its vibration.
using SegmentSystems = std::array<ContinuousTimeSystem, ScanVibration::kIntervals>;

/// Of `pairs` at `state`, weighted by its Geman-McClure kernel.
SegmentSystems linearize(const PatchPairs& pairs, const MotionState& state);

/// What the whole scan says.
ContinuousTimeSystem sum_of(const SegmentSystems& parts);

/// H of the pose by `pairs` as if all were right, without a kernel, and their squared range; b and error are left 0.
LinearSystem unweighted(const PatchPairs& pairs, const Pose& T_map_lidar);

}  // namespace tilth
