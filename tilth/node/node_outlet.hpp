// What a node hands out, for whichever middleware carries it on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tilth/messages/ros_message.hpp>

namespace tilth {

enum class NodeTopic : std::uint8_t { odometry, tf, tf_static, path, scan, map, diagnostics, pose };

struct PublishedTopic {
  NodeTopic topic;
  std::string name;      ///< "~/odometry": ~ is the node's own name
  std::string type;      ///< "nav_msgs/msg/Odometry"
  bool latched = false;  ///< who comes late gets the last message (transient local)
};

/// In the order of NodeTopic.
std::vector<PublishedTopic> node_topics();

class NodeOutlet {
 public:
  virtual ~NodeOutlet() = default;

  /// How messages are to be written, and how the clouds that come are: always the same.
  virtual Serialization serialization() const = 0;

  /// `message` is little-endian. Each topic's come one at a time, but from several threads.
  virtual void publish(NodeTopic topic, std::span<const std::byte> message) = 0;

  /// Whether anybody listens: else a scan or path that nobody asked for is not made.
  virtual bool wanted(NodeTopic topic) = 0;

  virtual void note(const std::string& sentence) = 0;  ///< to know
  virtual void warn(const std::string& sentence) = 0;  ///< to act on
};

}  // namespace tilth
