// Bags of every kind as one: topics, and messages in the order of their stamps.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <tilth/io/recording.hpp>

namespace tilth {

/// What it captures it owns.
struct BagReader {
  std::vector<Connection> connections;
  std::function<void(const std::string& topic)> select;  ///< only this topic from now on
  std::function<std::optional<Message>()> next;          ///< nothing at the end
  std::function<std::string()> problem;                  ///< what is damaged; empty: nothing
};

/// .bag, .db3, .mcap, or a folder that holds a ROS 2 bag.
bool is_bag(const std::filesystem::path& path);

/// Throws Error where it cannot be read.
BagReader open_bag_reader(const std::filesystem::path& path);

}  // namespace tilth
