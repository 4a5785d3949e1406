// The topics of a bag, and which of them is read.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <tilth/io/recording.hpp>
#include <tilth/messages/ros_message.hpp>

namespace tilth {

struct BagTopic {
  std::string name, type, encoding;
  std::size_t messages = 0;

  Serialization serialization() const { return encoding == "cdr" ? Serialization::cdr : Serialization::ros1; }
};

/// By name.
std::map<std::string, BagTopic> bag_topics(const std::vector<Connection>& connections);

/// For people, one line each.
std::vector<std::string> bag_topic_lines(const std::map<std::string, BagTopic>& topics);

/// Only those of packets.
std::map<std::string, BagTopic> packet_topics(const std::map<std::string, BagTopic>& topics);

/// The topic to read: the one asked for, else the only one of point clouds, else the only one of packets. Throws Error
/// listing the topics of `bag` where there is none or several.
BagTopic choose_bag_topic(const std::string& bag, const std::map<std::string, BagTopic>& topics,
                          const std::string& wanted);

}  // namespace tilth
