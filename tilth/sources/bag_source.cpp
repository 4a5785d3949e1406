#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sensor/packet_message.hpp>
#include <tilth/sensor/point_cloud2.hpp>
#include <tilth/sources/bag_reader.hpp>
#include <tilth/sources/bag_source.hpp>
#include <tilth/sources/packet_source.hpp>
#include <tilth/sources/recorded_source.hpp>

namespace tilth {
namespace {

bool is_cloud(const std::string& type) {
  return type == kPointCloud2Type || type == "sensor_msgs/msg/PointCloud2";
}

struct Topic {
  std::string name, type, encoding;
  std::size_t messages = 0;

  Serialization serialization() const { return encoding == "cdr" ? Serialization::cdr : Serialization::ros1; }
};

std::map<std::string, Topic> topics_of(const std::vector<Connection>& connections) {
  std::map<std::string, Topic> topics;
  for (const Connection& c : connections) {
    Topic& topic = topics[c.topic];
    topic.name = c.topic, topic.type = c.type, topic.encoding = c.encoding;
    topic.messages += std::size_t(c.messages);
  }
  return topics;
}

std::vector<std::string> topic_lines(const std::map<std::string, Topic>& topics) {
  std::vector<std::string> lines;
  for (const auto& [name, topic] : topics)
    lines.push_back("topic " + name + ": " + topic.type + ", " + std::to_string(topic.messages) + " messages");
  return lines;
}

/// The topic to read: the one asked for, else the only one of point clouds, else the only one of packets.
Topic choose_topic(const std::string& bag, const std::map<std::string, Topic>& topics, const std::string& wanted) {
  std::string has;
  std::vector<Topic> clouds, packets;
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
  const std::vector<Topic>& candidates = clouds.empty() ? packets : clouds;
  if (candidates.empty()) throw Error(bag, "no topic holds " + cloud_type + " or packets" + has);
  if (candidates.size() > 1) throw Error(bag, "several topics hold point clouds, name one by --topic" + has);
  return candidates.front();
}

/// Hands over the messages one by one, then what is damaged.
class CloudReader {
 public:
  CloudReader(std::string name, BagReader bag, Serialization serialization)
      : name_(std::move(name)), bag_(std::move(bag)), serialization_(serialization) {}

  std::optional<RecordedScan> operator()() {
    if (ended_) return std::nullopt;
    RecordedScan scan{next_, name_ + ", message " + std::to_string(next_), {}, ""};
    ++next_;
    try {
      const std::optional<Message> message = bag_.next();
      if (!message) return end();
      PointCloud2 cloud = parse_point_cloud2(message->bytes, serialization_);
      const double arrival = 1e-9 * double(message->stamp);
      scan.records = {{cloud.stamp > 0.0 ? cloud.stamp : arrival, arrival}, std::move(cloud.records)};
    } catch (const Error& error) {
      scan.problem = error.what();
    }
    return scan;
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
  std::size_t next_ = 0;
  bool ended_ = false;
};

/// Packets of messages, one by one.
class MessagePackets {
 public:
  MessagePackets(BagReader bag, const Topic& topic)
      : bag_(std::move(bag)), type_(topic.type), serialization_(topic.serialization()) {}

  std::optional<ReceivedPacket> next() {
    while (waiting_.empty()) {
      const std::optional<Message> message = bag_.next();
      if (!message) return std::nullopt;
      take(*message);
    }
    ReceivedPacket packet = std::move(waiting_.front());
    waiting_.pop_front();
    return packet;
  }

  std::string problem() const {
    const std::string damage = bag_.problem();
    return damage.empty() || problem_.empty() ? damage + problem_ : damage + "; " + problem_;
  }

 private:
  void take(const Message& message) {
    try {
      for (const StampedPayload& p : parse_packet_message(type_, message.bytes, serialization_)) {
        const double arrival = p.stamp > 0.0 ? p.stamp : 1e-9 * double(message.stamp);
        waiting_.push_back({arrival, 0, {p.payload.begin(), p.payload.end()}});
      }
    } catch (const Error& error) {
      if (problem_.empty()) problem_ = error.what();
    }
  }

  BagReader bag_;
  std::string type_, problem_;
  Serialization serialization_;
  std::deque<ReceivedPacket> waiting_;
};

}  // namespace

std::unique_ptr<ScanSource> open_bag(const std::filesystem::path& path, const SourceOptions& options,
                                     const OptionValues& packets) {
  BagReader bag = open_bag_reader(path);
  const std::map<std::string, Topic> topics = topics_of(bag.connections);
  const Topic topic = choose_topic(path.string(), topics, options.topic);
  bag.select(topic.name);
  const std::string source = "topic " + topic.name + " of " + path.string();
  if (is_packet_message(topic.type)) {
    const auto reader = std::make_shared<MessagePackets>(std::move(bag), topic);
    return open_packets({source, topic_lines(topics), [reader] { return reader->next(); },
                         [] { return std::vector<std::string>{}; }, [reader] { return reader->problem(); }},
                        with<PacketSourceOptions>(packets));
  }
  if (!packets.empty())
    throw Error("option " + packets.begin()->first, "means nothing for the point clouds of " + source);
  std::vector<std::string> decisions{"source: " + source + ", " + std::to_string(topic.messages) + " messages",
                                     "stamps: of the message headers; where one is 0, of the recorder"};
  auto recorded = std::make_unique<RecordedSource>(CloudReader(path.string(), std::move(bag), topic.serialization()),
                                                   RecordingTraits{}, std::move(decisions), topic.messages);
  recorded->add_contents(topic_lines(topics));
  return recorded;
}

}  // namespace tilth
