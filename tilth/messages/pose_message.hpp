// Poses as ROS 2 messages in CDR: nav_msgs/Odometry, nav_msgs/Path, tf2_msgs/TFMessage.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tilth/core/trajectory.hpp>

namespace tilth {

struct Frames {
  std::string world = "world", lidar = "lidar";
};

/// All throw Error where a stamp lies outside [0, 2^32 - 1) s. `variances` are those of the pose in the LiDAR frame,
/// rotation [rad^2], translation [m^2]; the message has them in the world's axes. It tells no velocity: the first
/// number of that covariance is -1, as is usual.
std::vector<std::byte> serialize_odometry(const StampedPose& pose, const Vector6d& variances, const Frames& frames);
std::vector<std::byte> serialize_tf(const StampedPose& pose, const Frames& frames);
std::vector<std::byte> serialize_path(const Trajectory& trajectory, const Frames& frames);

}  // namespace tilth
