// Constant velocity between scans, on their stamps: whoever drops a scan or turns slower does not change it.
#pragma once

#include <algorithm>

#include <tilth/core/se3.hpp>

namespace tilth {

class ConstantVelocity {
 public:
  ConstantVelocity() = default;
  /// Before any update it is at `T_world_lidar`.
  explicit ConstantVelocity(const Pose& T_world_lidar) : T_world_lidar_(T_world_lidar) {}

  /// The pose expected at `time` [s], or, for a time before the last update, the one that was passed; before any
  /// update, where it is.
  Pose predict(double time) const {
    constexpr double kCarriedOn = 1.0;  // [s] at most: after that it is not known to have gone on
    return updates_ == 0 ? T_world_lidar_ : retract(T_world_lidar_, velocity_ * std::min(time - time_, kCarriedOn));
  }

  /// Takes the pose found at `time`; the velocity is the motion since the last one.
  void update(double time, const Pose& T_world_lidar) {
    velocity_ = velocity_to(time, T_world_lidar);
    T_world_lidar_ = T_world_lidar;
    time_ = time;
    ++updates_;
  }

  /// The velocity that leads from the last pose to `T_world_lidar` at `time`, or, before any update, zero.
  Vector6d velocity_to(double time, const Pose& T_world_lidar) const {
    return updates_ == 0 || time <= time_ ? velocity_
                                          : Vector6d(log(T_world_lidar_.inverse() * T_world_lidar) / (time - time_));
  }

  const Vector6d& velocity() const { return velocity_; }    ///< [rad/s, m/s] in the LiDAR's own frame
  const Pose& last_pose() const { return T_world_lidar_; }  ///< before any update, where it is
  double last_time() const { return time_; }                ///< [s] of the last pose
  int updates() const { return updates_; }

 private:
  Pose T_world_lidar_ = Pose::Identity();
  Vector6d velocity_ = Vector6d::Zero();
  double time_ = 0.0;
  int updates_ = 0;
};

}  // namespace tilth
