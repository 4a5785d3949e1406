#include <map>
#include <string>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/messages/packet_message.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sources/bag_packets.hpp>
#include <tilth/sources/bag_source.hpp>
#include <tilth/sources/frame_choice.hpp>
#include <tilth/sources/packet_source.hpp>
#include <tilth/sources/recorded_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

/// Hands over the messages of one frame one by one, then what is damaged.
class CloudReader {
 public:
  CloudReader(std::string name, BagReader bag, Serialization serialization, std::shared_ptr<FrameChoice> frames)
      : name_(std::move(name)), bag_(std::move(bag)), serialization_(serialization), frames_(std::move(frames)) {}

  std::optional<RecordedScan> operator()() {
    while (!ended_) {
      RecordedScan scan{next_, name_ + ", message " + std::to_string(next_), {}, ""};
      ++next_;
      try {
        const std::optional<Message> message = bag_.next();
        if (!message) return end();
        PointCloud2 cloud = parse_point_cloud2(message->bytes, serialization_);
        if (!frames_->takes(cloud.frame_id)) continue;
        scan.records = {{cloud.stamp, 1e-9 * double(message->stamp)}, std::move(cloud.records)};
      } catch (const Error& error) {
        scan.problem = error.what();
      }
      return scan;
    }
    return std::nullopt;
  }

 private:
  std::optional<RecordedScan> end() {
    ended_ = true;
    if (bag_.problem().empty()) return std::nullopt;
    return RecordedScan{next_ - 1, name_, {}, "the recording is damaged: " + bag_.problem()};
  }

  std::string name_;
  BagReader bag_;
  Serialization serialization_;
  std::shared_ptr<FrameChoice> frames_;
  std::size_t next_ = 0;
  bool ended_ = false;
};

}  // namespace

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
  std::vector<std::string> decisions{"source: " + source + ", " + std::to_string(topic.messages) + " messages",
                                     "stamps: of the message headers, where they tell scans apart"};
  const auto frames = std::make_shared<FrameChoice>(options.frame);
  try {
    auto recorded = std::make_unique<RecordedSource>(
        CloudReader(path.string(), std::move(bag), topic.serialization(), frames),
        RecordingTraits{.times = clouds.times, .unit = clouds.unit}, std::move(decisions), topic.messages);
    if (const std::string frame = frames->decision(); !frame.empty()) recorded->add_decision(frame);
    recorded->add_notices([frames] { return frames->notices(); });
    recorded->add_contents(bag_topic_lines(topics));
    return recorded;
  } catch (const Error&) {
    if (!frames->problem().empty()) throw Error(path.string(), frames->problem());
    throw;
  }
}

}  // namespace tilth
