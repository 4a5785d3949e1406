// What a registration found, and how far it is to be believed.
#pragma once

#include <tilth/core/se3.hpp>

namespace tilth {

struct AlignResult {
  Pose T_target_source = Pose::Identity();
  bool converged = false;
  int iterations = 0;
  std::size_t candidates = 0;  ///< source points that were looked up
  std::size_t matches = 0;     ///< pairs that passed the pre-check in the last iteration
  double weight = 0.0;         ///< sum of the kernel's weights over the matches: as many of them agree
  double error = 0.0;          ///< 1/2 sum of weighted squared residuals at the end
  /// H = J^T J of the last iteration, in the source frame (right perturbation)
  Matrix6d information = Matrix6d::Zero();
  /// of the pose, from H and the residual scale [rad^2, m^2]; never all zeros after a match
  Matrix6d covariance = Matrix6d::Zero();
  int degenerate_directions = 0;  ///< directions of the six that the scan does not determine
};

}  // namespace tilth
