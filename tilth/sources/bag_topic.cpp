#include <tilth/core/error.hpp>
#include <tilth/messages/packet_message.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sources/bag_topic.hpp>

namespace tilth {
namespace {

bool is_cloud(const std::string& type) {
  return type == kPointCloud2Type || type == "sensor_msgs/msg/PointCloud2";
}

}  // namespace

std::map<std::string, BagTopic> bag_topics(const std::vector<Connection>& connections) {
  std::map<std::string, BagTopic> topics;
  for (const Connection& c : connections) {
    BagTopic& topic = topics[c.topic];
    topic.name = c.topic, topic.type = c.type, topic.encoding = c.encoding;
    topic.messages += std::size_t(c.messages);
  }
  return topics;
}

std::vector<std::string> bag_topic_lines(const std::map<std::string, BagTopic>& topics) {
  std::vector<std::string> lines;
  for (const auto& [name, topic] : topics)
    lines.push_back("topic " + name + ": " + topic.type + ", " + std::to_string(topic.messages) + " messages");
  return lines;
}

std::map<std::string, BagTopic> packet_topics(const std::map<std::string, BagTopic>& topics) {
  std::map<std::string, BagTopic> packets = topics;
  std::erase_if(packets, [](const auto& topic) { return !is_packet_message(topic.second.type); });
  return packets;
}

BagTopic choose_bag_topic(const std::string& bag, const std::map<std::string, BagTopic>& topics,
                          const std::string& wanted) {
  std::string has;
  std::vector<BagTopic> clouds, packets;
  for (const auto& [name, topic] : topics) {
    has += (has.empty() ? "; the bag has " : ", ") + name + " (" + topic.type + ")";
    if (topic.encoding != "cdr" && topic.encoding != "ros1") continue;
    if (is_cloud(topic.type)) clouds.push_back(topic);
    if (is_packet_message(topic.type)) packets.push_back(topic);
  }
  if (has.empty()) has = "; the bag has no topics";
  const std::string cloud_type(kPointCloud2Type);
  if (!wanted.empty()) {
    const auto it = topics.find(wanted);
    if (it != topics.end() && (is_cloud(it->second.type) || is_packet_message(it->second.type))) return it->second;
    throw Error(bag, "topic " + wanted + " holds no " + cloud_type + " or packets" + has);
  }
  const std::vector<BagTopic>& candidates = clouds.empty() ? packets : clouds;
  if (candidates.empty()) throw Error(bag, "no topic holds " + cloud_type + " or packets" + has);
  if (candidates.size() > 1) throw Error(bag, "several topics hold point clouds, name one by --topic" + has);
  return candidates.front();
}

}  // namespace tilth
