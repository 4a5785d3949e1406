// What one client of a view is to be sent: its subscriptions, and a bounded queue of messages for each topic, of which
// the newest win. Memory is bounded whatever the client does: no more than kWaiting messages a topic. Knows no sockets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/run/run_messages.hpp>
#include <tilth/view/foxglove.hpp>

namespace tilth {

/// A message of a topic, which all clients share.
struct ViewMessage {
  RunTopic topic = RunTopic::path;
  std::uint64_t nanoseconds = 0;
  std::shared_ptr<const std::vector<std::byte>> bytes;
};

/// How many messages of a topic may wait, by RunTopic: of path and map, which hold all that was before, one.
inline constexpr std::array<std::size_t, kRunTopics> kWaiting{1, 1, 50, 50, 3, 50};

/// What goes out as one frame: a text, or a head with a message behind it.
struct ViewFrame {
  bool is_text = true;
  std::string text;  ///< or the head
  std::shared_ptr<const std::vector<std::byte>> bytes;
};

class ClientFeed {
 public:
  /// Greets with `greetings`, texts.
  explicit ClientFeed(std::vector<std::string> greetings);

  /// Takes what the client sent; answers, where there is something to answer, wait to be sent. The topics that are
  /// subscribed to since.
  std::vector<RunTopic> take_text(std::string_view text);
  void take_binary();  ///< is told that it is not heard

  bool subscribed(RunTopic topic) const { return ids_[std::size_t(topic)].has_value(); }

  /// The oldest message of the topic that waits makes way where there are too many.
  void offer(const ViewMessage& message);

  /// What is to be sent next: texts first, then the topics in turn; now and then how much was left out. Nothing where
  /// nothing waits.
  std::optional<ViewFrame> next();

  /// Messages that made way, but for those that the newer ones hold.
  std::size_t dropped() const { return dropped_; }
  bool flooding() const { return flooding_; }  ///< the client asks faster than it reads: it is to be cut off

 private:
  void answer(std::string text);
  void subscribe(std::uint32_t id, std::uint32_t channel);
  std::optional<ViewFrame> next_message();

  std::deque<std::string> texts_;
  std::array<std::optional<std::uint32_t>, kRunTopics> ids_;  // of the subscriptions
  std::array<std::deque<ViewMessage>, kRunTopics> waiting_;
  std::size_t turn_ = 0;  // topic that is next
  std::size_t dropped_ = 0, told_ = 0;
  bool flooding_ = false;
};

/// The channels of a run, numbered from 1 in the order of RunTopic.
std::vector<ViewChannel> view_channels();

}  // namespace tilth
