// The fixed transforms of a robot, as they are told on /tf_static, and the one that is asked of them.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include <tilth/core/se3.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

class StaticTransforms {
 public:
  /// Takes a tf2_msgs/TFMessage; throws Error where it cannot be read.
  void add(std::span<const std::byte> message, Serialization serialization);

  /// T_base_child, over whatever frames lie between; nothing where it is not known so long after this was asked.
  std::optional<Pose> wait_for(const std::string& base, const std::string& child, std::chrono::milliseconds longest);

 private:
  struct Fixed {
    std::string parent;
    Pose T_parent_child;
  };
  struct Rooted {
    std::string root;
    Pose T_root_frame;
  };
  std::optional<Rooted> rooted(std::string frame) const;
  std::optional<Pose> find(const std::string& base, const std::string& child) const;

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::map<std::string, Fixed> by_child_;
};

}  // namespace tilth
