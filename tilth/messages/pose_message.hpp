// Poses as ROS messages: nav_msgs/Odometry, nav_msgs/Path, tf2_msgs/TFMessage.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

struct Frames {
  std::string world = "world", body = "lidar";  ///< the body is what the poses are of
};

struct StampedTransform {
  double stamp = 0.0;  ///< [s]
  Frames frames = {};
  Pose T_world_body = Pose::Identity();
};

/// All throw Error where a stamp lies outside [0, 2^32 - 1) s. `covariance` is that of the pose in the body's frame
/// (right perturbation), rotation [rad^2] before translation [m^2]; the message has it in the world's axes, translation
/// first. It tells no velocity: the first number of that covariance is -1, as is usual.
std::vector<std::byte> serialize_odometry(const StampedPose& pose, const Matrix6d& covariance, const Frames& frames,
                                          Serialization serialization = Serialization::cdr);
std::vector<std::byte> serialize_tf(std::span<const StampedTransform> transforms,
                                    Serialization serialization = Serialization::cdr);
std::vector<std::byte> serialize_path(const Trajectory& trajectory, const Frames& frames,
                                      Serialization serialization = Serialization::cdr);

}  // namespace tilth
