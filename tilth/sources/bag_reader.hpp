// Bags of every kind as one: topics, and messages in the order of their stamps.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <tilth/io/recording.hpp>
#include <tilth/sensor/ros_message.hpp>

namespace tilth {

/// What it captures it owns.
struct BagReader {
  std::vector<Connection> connections;
  Serialization serialization = Serialization::ros1;
  std::function<void(const std::string& topic)> select;  ///< only this topic from now on
  std::function<std::optional<Message>()> next;          ///< nothing at the end
  std::function<std::string()> problem;                  ///< what is damaged; empty: nothing
};

/// A ROS 1 bag, or a ROS 2 bag (.db3, or a folder of such). Throws Error where it cannot be read.
BagReader open_bag_reader(const std::filesystem::path& path);

}  // namespace tilth
