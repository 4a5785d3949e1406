#include <map>
#include <string>
#include <utility>

#include <tilth/messages/packet_message.hpp>
#include <tilth/sources/bag_packets.hpp>
#include <tilth/sources/bag_source.hpp>
#include <tilth/sources/cloud_source.hpp>
#include <tilth/sources/packet_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {

std::unique_ptr<ScanSource> open_bag(const std::filesystem::path& path, const SourceOptions& options) {
  BagReader bag = open_bag_reader(path);
  const std::map<std::string, BagTopic> topics = bag_topics(bag.connections);
  const BagTopic topic = choose_bag_topic(path.string(), topics, options.topic);
  const std::string source = "topic " + topic.name + " of " + path.string();
  if (is_packet_message(topic.type)) {
    PacketFeed feed = bag_packet_feed(std::move(bag), topic, source, options.frame);
    feed.contents = bag_topic_lines(topics);
    feed.file = path;
    return open_packets(std::move(feed), options_of<PacketSourceOptions>("the packets of " + source, options.values));
  }
  bag.select(topic.name);
  const auto clouds = options_of<CloudOptions>("the point clouds of " + source, options.values);
  auto recorded =
      open_clouds({.name = path.string(),
                   .next = bag.next,
                   .problem = bag.problem,
                   .serialization = topic.serialization(),
                   .size = topic.messages},
                  options.frame, clouds, {"source: " + source + ", " + std::to_string(topic.messages) + " messages"});
  recorded->add_contents(bag_topic_lines(topics));
  return recorded;
}

}  // namespace tilth
