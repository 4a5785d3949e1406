// Poses inside ROS messages: geometry_msgs/Pose and Transform, which are laid out alike, and covariances of them.
#pragma once

#include <string>

#include <tilth/core/se3.hpp>
#include <tilth/messages/ros_message.hpp>
#include <tilth/messages/ros_message_writer.hpp>

namespace tilth {

/// Throws Error, naming `type`, where it ends before, or the pose is no rigid motion.
Pose read_pose(RosMessageReader& reader, const std::string& type);

void write_pose(RosMessageWriter& writer, const Pose& pose);

/// `covariance` is that of the pose in the body's frame (right perturbation), rotation [rad^2] before translation
/// [m^2]; written in the world's axes, translation first.
void write_covariance(RosMessageWriter& writer, const Matrix6d& covariance, const Pose& T_world_body);

}  // namespace tilth
