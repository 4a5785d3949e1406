// Constant velocity between scans, on their stamps: whoever drops a scan or turns slower does not change it.
#pragma once

#include <tilth/core/se3.hpp>

namespace tilth {

class ConstantVelocity {
 public:
  /// The pose expected at `time` [s], or, for a time before the last update, the one that was passed; the first pose
  /// before any update is the identity.
  Pose predict(double time) const {
    return updates_ == 0 ? Pose::Identity() : retract(T_world_lidar_, velocity_ * (time - time_));
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
  const Pose& last_pose() const { return T_world_lidar_; }  ///< the identity before any update
  double last_time() const { return time_; }                ///< [s] of the last pose
  int updates() const { return updates_; }

 private:
  Pose T_world_lidar_ = Pose::Identity();
  Vector6d velocity_ = Vector6d::Zero();
  double time_ = 0.0;
  int updates_ = 0;
};

}  // namespace tilth
