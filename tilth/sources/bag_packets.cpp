#include <deque>
#include <memory>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/messages/packet_message.hpp>
#include <tilth/sources/bag_packets.hpp>
#include <tilth/sources/frame_choice.hpp>

namespace tilth {
namespace {

/// Packets of messages, one by one.
class MessagePackets {
 public:
  MessagePackets(BagReader bag, const BagTopic& topic, const std::string& frame)
      : bag_(std::move(bag)), type_(topic.type), serialization_(topic.serialization()), frames_(frame) {}

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

  std::vector<std::string> notices() const { return frames_.notices(); }

 private:
  void take(const Message& message) {
    try {
      if (!frames_.takes(packet_message_frame(type_, message.bytes, serialization_))) return;
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
  FrameChoice frames_;
  std::deque<ReceivedPacket> waiting_;
};

}  // namespace

PacketFeed bag_packet_feed(BagReader bag, const BagTopic& topic, const std::string& name, const std::string& frame) {
  bag.select(topic.name);
  const auto reader = std::make_shared<MessagePackets>(std::move(bag), topic, frame);
  return {name,
          {},
          [reader] { return reader->next(); },
          [reader] { return reader->notices(); },
          [reader] { return reader->problem(); }};
}

}  // namespace tilth
