#include <map>
#include <string>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/rosbag1.hpp>
#include <tilth/sensor/point_cloud2.hpp>
#include <tilth/sources/bag_source.hpp>
#include <tilth/sources/recorded_source.hpp>

namespace tilth {
namespace {

std::string listed(const std::vector<Connection>& connections) {
  std::map<std::string, std::string> types;
  for (const Connection& connection : connections) types[connection.topic] = connection.type;
  std::string text;
  for (const auto& [topic, type] : types) text += (text.empty() ? "" : ", ") + topic + " (" + type + ")";
  return text.empty() ? "no topics" : text;
}

std::vector<std::string> topic_lines(const std::vector<Connection>& connections) {
  std::map<std::string, std::uint64_t> messages;
  for (const Connection& connection : connections)
    messages["topic " + connection.topic + ": " + connection.type] += connection.messages;
  std::vector<std::string> lines;
  for (const auto& [topic, count] : messages) lines.push_back(topic + ", " + std::to_string(count) + " messages");
  return lines;
}

/// The topic to read and the messages it holds.
std::pair<std::string, std::size_t> cloud_topic(const std::string& bag, const std::vector<Connection>& connections,
                                                const std::string& wanted) {
  std::map<std::string, std::size_t> clouds;
  for (const Connection& connection : connections) {
    if (connection.type == kPointCloud2Type) clouds[connection.topic] += std::size_t(connection.messages);
  }
  const std::string has = "; the bag has " + listed(connections);
  if (!wanted.empty()) {
    const auto it = clouds.find(wanted);
    if (it == clouds.end()) throw Error(bag, "topic " + wanted + " holds no " + std::string(kPointCloud2Type) + has);
    return *it;
  }
  if (clouds.empty()) throw Error(bag, "no topic holds " + std::string(kPointCloud2Type) + has);
  if (clouds.size() > 1) throw Error(bag, "several topics hold point clouds, name one by --topic" + has);
  return *clouds.begin();
}

/// Hands over the messages one by one, then what is damaged.
class MessageReader {
 public:
  MessageReader(std::string name, std::shared_ptr<Rosbag1Reader> bag) : name_(std::move(name)), bag_(std::move(bag)) {}

  std::optional<RecordedScan> operator()() {
    if (ended_) return std::nullopt;
    RecordedScan scan{next_, name_ + ", message " + std::to_string(next_), {}, ""};
    ++next_;
    try {
      const std::optional<Message> message = bag_->next();
      if (!message) return end();
      PointCloud2 cloud = parse_point_cloud2(message->bytes);
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
    if (bag_->problem().empty()) return std::nullopt;
    return RecordedScan{next_ - 1, name_, {}, "the recording is damaged: " + bag_->problem()};
  }

  std::string name_;
  std::shared_ptr<Rosbag1Reader> bag_;
  std::size_t next_ = 0;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<ScanSource> open_bag(const std::filesystem::path& path, const SourceOptions& options) {
  auto bag = std::make_shared<Rosbag1Reader>(path);
  const auto [topic, messages] = cloud_topic(path.string(), bag->connections(), options.topic);
  bag->select({topic});
  std::vector<std::string> decisions{
      "source: topic " + topic + " of " + path.string() + ", " + std::to_string(messages) + " messages",
      "stamps: of the message headers; where one is 0, of the recorder"};
  std::vector<std::string> topics = topic_lines(bag->connections());
  auto source = std::make_unique<RecordedSource>(MessageReader(path.string(), std::move(bag)), RecordingTraits{},
                                                 std::move(decisions), messages);
  source->add_contents(std::move(topics));
  return source;
}

}  // namespace tilth
