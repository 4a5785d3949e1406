// geometry_msgs/PoseWithCovarianceStamped: where a robot is, as a localisation says it, or somebody guesses.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

/// Throws Error where the stamp lies outside [0, 2^32 - 1) s. `covariance` as of serialize_odometry().
std::vector<std::byte> serialize_pose_estimate(const StampedPose& pose, const Matrix6d& covariance,
                                               const std::string& world,
                                               Serialization serialization = Serialization::cdr);

struct PoseGuess {
  std::string world;  ///< its frame
  Pose T_world_body;
};

/// Throws Error where the message is cut or the pose is no rigid motion. The covariance is not looked at.
PoseGuess parse_pose_guess(std::span<const std::byte> message, Serialization serialization);

}  // namespace tilth
