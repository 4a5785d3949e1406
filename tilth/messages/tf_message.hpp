// tf2_msgs/TFMessage read: transforms between frames, as robots tell them on /tf and /tf_static.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tilth/messages/pose_message.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

/// Throws Error where the message ends before its last transform, or one is no rigid motion.
std::vector<StampedTransform> parse_tf(std::span<const std::byte> message, Serialization serialization);

}  // namespace tilth
