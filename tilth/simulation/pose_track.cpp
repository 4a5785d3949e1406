#include <algorithm>
#include <cassert>
#include <limits>

#include <tilth/simulation/pose_track.hpp>

namespace tilth {

Pose PoseTrack::at(double stamp) {
  if (!from_ || stamp < begin_ || stamp >= end_) enter(stamp);
  return from_->T_world_lidar * exp((stamp - from_->stamp) * motion_);
}

void PoseTrack::enter(double stamp) {
  assert(!trajectory_.empty());
  constexpr double kForever = std::numeric_limits<double>::infinity();
  from_ = &trajectory_.front(), begin_ = -kForever, end_ = kForever;
  if (trajectory_.size() == 1) return;
  const auto after = std::upper_bound(trajectory_.begin() + 1, trajectory_.end() - 1, stamp,
                                      [](double t, const StampedPose& pose) { return t < pose.stamp; });
  from_ = &*(after - 1);
  if (after != trajectory_.begin() + 1) begin_ = from_->stamp;
  if (after != trajectory_.end() - 1) end_ = after->stamp;
  const Pose T = from_->T_world_lidar.inverse(Eigen::Isometry) * after->T_world_lidar;
  motion_ = log(T) / (after->stamp - from_->stamp);
}

}  // namespace tilth
