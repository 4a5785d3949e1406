#include <algorithm>
#include <deque>
#include <future>
#include <memory>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/payload_file.hpp>
#include <tilth/sensor/packet_encoder.hpp>
#include <tilth/sensor/recognise_packets.hpp>
#include <tilth/sources/bag_packets.hpp>
#include <tilth/sources/open_simulator.hpp>
#include <tilth/sources/packet_feeds.hpp>
#include <tilth/sources/packet_files.hpp>
#include <tilth/sources/simulated_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kSensor = 0xC0A801C8;  // 192.168.1.200

class SimulatedPackets {
 public:
  explicit SimulatedPackets(OpenedSimulator opened)
      : simulator_(std::move(opened.simulator)), stream_(simulator_->lidar()) {}

  std::optional<ReceivedPacket> next() {
    if (waiting_.empty()) {
      std::vector<EncodedPacket> packets = ahead_.valid() ? ahead_.get() : make();
      ahead_ = std::async(std::launch::async, [this] { return make(); });
      std::move(packets.begin(), packets.end(), std::back_inserter(waiting_));
    }
    if (waiting_.empty()) return std::nullopt;
    EncodedPacket packet = std::move(waiting_.front());
    waiting_.pop_front();
    return ReceivedPacket{packet.sent, kSensor, std::move(packet.payload)};
  }

 private:
  std::vector<EncodedPacket> make() {
    if (index_ >= simulator_->size()) return {};
    return stream_.encode(simulator_->scan(index_++).scan);
  }

  std::unique_ptr<Simulator> simulator_;
  PacketStream stream_;
  std::size_t index_ = 0;
  std::deque<EncodedPacket> waiting_;
  std::future<std::vector<EncodedPacket>> ahead_;  // last: its thread uses the members above
};

PacketFeed simulation_feed(const std::string& uri) {
  const SourceUri source = parse_source_uri(uri.substr(kSimulatedScheme.size()));
  const auto packets = std::make_shared<SimulatedPackets>(open_simulator(source.what, source.values));
  return {uri,
          {},
          [packets] { return packets->next(); },
          [] { return std::vector<std::string>{}; },
          [] { return std::string{}; }};
}

PacketFeed bag_feed(const fs::path& path, const std::string& topic) {
  BagReader bag = open_bag_reader(path);
  const std::map<std::string, BagTopic> all = bag_topics(bag.connections), packets = packet_topics(all);
  const BagTopic chosen = choose_bag_topic(path.string(), packets.empty() ? all : packets, topic);
  if (packets.empty()) throw Error(path.string(), "holds point clouds but no packets; topic " + chosen.name);
  return bag_packet_feed(std::move(bag), chosen, "topic " + chosen.name + " of " + path.string(), "");
}

/// Gives packets without arrival one, a period of the sensor after the one before.
class PacedPackets {
 public:
  explicit PacedPackets(PacketFeed feed) : feed_(std::move(feed)) {
    constexpr std::size_t kFirst = 200;
    std::vector<Packet> packets;
    while (first_.size() < kFirst) {
      std::optional<ReceivedPacket> packet = feed_.next();
      if (!packet) break;
      first_.push_back(std::move(*packet));
    }
    for (const ReceivedPacket& p : first_) packets.push_back({p.payload, p.arrival});
    const PacketConvention convention = recognise_packets(packets, "");
    period_ = convention.format.packet_period(convention.dual);
  }

  std::optional<ReceivedPacket> next() {
    std::optional<ReceivedPacket> packet;
    if (first_.empty()) {
      packet = feed_.next();
    } else {
      packet = std::move(first_.front());
      first_.pop_front();
    }
    if (packet) packet->arrival = period_ * double(++sent_);
    return packet;
  }

  std::string problem() const { return feed_.problem(); }

 private:
  PacketFeed feed_;
  std::deque<ReceivedPacket> first_;
  double period_ = 0.0;  // [s]
  std::size_t sent_ = 0;
};

PacketFeed paced_feed(PacketFeed feed) {
  const std::string name = feed.name;
  const auto packets = std::make_shared<PacedPackets>(std::move(feed));
  return {name,
          {},
          [packets] { return packets->next(); },
          [] { return std::vector<std::string>{}; },
          [packets] { return packets->problem(); }};
}

}  // namespace

bool may_hold_packets(const std::string& uri) {
  if (uri.starts_with(kSimulatedScheme)) return true;
  std::error_code error;
  const bool file = fs::is_regular_file(uri, error);
  return (file && (is_capture(uri) || is_payload_file(uri))) || (fs::exists(uri, error) && is_bag(uri));
}

PacketFeed open_packet_feed(const std::string& uri, const std::string& topic) {
  if (uri.starts_with(kSimulatedScheme)) return simulation_feed(uri);
  if (!fs::exists(uri)) throw Error(uri, "no such file");
  if (fs::is_regular_file(uri) && is_capture(uri)) return capture_feed(uri);
  if (is_bag(uri)) return bag_feed(uri, topic);
  if (fs::is_regular_file(uri) && is_payload_file(uri)) return paced_feed(payload_feed(uri));
  throw Error(uri, "holds no packets: expected .pcap, .pcapng, a bag with packets, bare payloads or sim://SCENE");
}

}  // namespace tilth
