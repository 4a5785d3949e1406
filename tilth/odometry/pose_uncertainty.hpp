// How far a pose is to be believed in the frame of the first one. A scan is registered to surfaces that earlier scans
// left in the map, and inherits their errors: its covariance is that of the pose at the mean time at which its surfaces
// were seen, and its own on top. New ground makes it grow by and by; back among old surfaces it shrinks again. Along
// directions that the surfaces say nothing about it inherits the error of the last pose instead. O(1) a scan.
#pragma once

#include <vector>

#include <tilth/core/se3.hpp>

namespace tilth {

/// A pose found at `time`, with the covariance that it has where the surfaces are exact, and when these were seen.
struct RegisteredPose {
  double time = 0.0;                       ///< [s]
  Pose T_map_lidar = Pose::Identity();     ///< at `time`
  Matrix6d covariance = Matrix6d::Zero();  ///< [rad^2, m^2] in the LiDAR's frame (right perturbation)
  double surfaces_seen_at = 0.0;           ///< [s] on average; not after `time`
  /// * x is the part of a motion x in the LiDAR's frame that the surfaces say nothing about: there the error of the
  /// last pose goes on
  Matrix6d dead_reckoned = Matrix6d::Zero();
};

class PoseUncertainty {
 public:
  /// Covariance of the pose in the map's frame, which is exact at the time of the first one; right perturbation. Times
  /// must ascend.
  Matrix6d add(const RegisteredPose& pose);

 private:
  struct Instant {
    double time;
    Matrix6d covariance_in_map;  // left perturbation
  };

  Matrix6d covariance_at(double time) const;

  std::vector<Instant> instants_;  // some a second
  Matrix6d last_covariance_in_map_ = Matrix6d::Zero();
};

}  // namespace tilth
