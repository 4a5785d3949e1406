// The same poses as interpolate(trajectory, stamp), for stamps that follow closely on one another: the logarithm
// between two neighbours is taken once. About 60 ns a pose.
#pragma once

#include <tilth/core/trajectory.hpp>

namespace tilth {

class PoseTrack {
 public:
  /// The trajectory must outlive the track and hold at least one pose.
  explicit PoseTrack(const Trajectory& trajectory) : trajectory_(trajectory) {}

  Pose at(double stamp);

 private:
  void enter(double stamp);

  const Trajectory& trajectory_;
  const StampedPose* from_ = nullptr;
  double begin_ = 0, end_ = 0;          // [s] for which `motion_` holds
  Vector6d motion_ = Vector6d::Zero();  // tangent per second from `from_` on
};

}  // namespace tilth
