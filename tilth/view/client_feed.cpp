#include <utility>

#include <tilth/core/counted.hpp>
#include <tilth/core/error.hpp>
#include <tilth/view/client_feed.hpp>
#include <tilth/view/foxglove.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostTexts = 100;     // that wait to be sent
constexpr std::size_t kUntoldAtMost = 100;  // messages left out, until the client is told

}  // namespace

std::vector<ViewChannel> view_channels() {
  std::vector<ViewChannel> channels;
  for (NamedTopic& topic : run_topics())
    channels.push_back({std::uint32_t(channels.size() + 1), std::move(topic.name), std::move(topic.type)});
  return channels;
}

ClientFeed::ClientFeed(std::vector<std::string> greetings) : texts_(greetings.begin(), greetings.end()) {}

void ClientFeed::answer(std::string text) {
  flooding_ = flooding_ || texts_.size() >= kMostTexts;
  if (!flooding_) texts_.push_back(std::move(text));
}

void ClientFeed::subscribe(std::uint32_t id, std::uint32_t channel) {
  if (channel == 0 || channel > kRunTopics) throw Error("subscribe", "there is no channel " + std::to_string(channel));
  std::optional<std::uint32_t>& own = ids_[channel - 1];
  if (own) throw Error("subscribe", "channel " + std::to_string(channel) + " is subscribed to already");
  for (const std::optional<std::uint32_t>& other : ids_) {
    if (other == id) throw Error("subscribe", "subscription " + std::to_string(id) + " is there already");
  }
  own = id;
}

std::vector<RunTopic> ClientFeed::take_text(std::string_view text) {
  std::vector<RunTopic> begun;
  try {
    const ClientRequest request = parse_request(text);
    for (const auto& [id, channel] : request.subscribe) {
      subscribe(id, channel);
      begun.push_back(RunTopic(channel - 1));
    }
    for (const std::uint32_t id : request.unsubscribe) {
      for (std::size_t topic = 0; topic < kRunTopics; ++topic) {
        if (ids_[topic] != id) continue;
        ids_[topic].reset();
        waiting_[topic].clear();
      }
    }
  } catch (const Error& e) {
    answer(status(StatusLevel::error, e.what()));
  }
  return begun;
}

void ClientFeed::take_binary() {
  answer(status(StatusLevel::error, "this server takes no data from clients"));
}

void ClientFeed::offer(const ViewMessage& message) {
  if (!subscribed(message.topic)) return;
  const std::size_t most = kWaiting[std::size_t(message.topic)];
  std::deque<ViewMessage>& waiting = waiting_[std::size_t(message.topic)];
  if (waiting.size() >= most) {
    waiting.pop_front();
    if (most > 1) ++dropped_;
  }
  waiting.push_back(message);
}

std::optional<ViewFrame> ClientFeed::next() {
  if (texts_.empty() && dropped_ < told_ + kUntoldAtMost) {
    if (std::optional<ViewFrame> message = next_message()) return message;
  }
  if (texts_.empty() && dropped_ > told_) {
    texts_.push_back(status(StatusLevel::warning, counted(dropped_ - told_, "message") +
                                                      " left out: this client reads more slowly than they come"));
    told_ = dropped_;
  }
  if (texts_.empty()) return std::nullopt;
  ViewFrame frame{true, std::move(texts_.front()), nullptr};
  texts_.pop_front();
  return frame;
}

std::optional<ViewFrame> ClientFeed::next_message() {
  for (std::size_t i = 0; i < kRunTopics; ++i) {
    const std::size_t topic = turn_;
    turn_ = (turn_ + 1) % kRunTopics;
    if (waiting_[topic].empty()) continue;
    const ViewMessage message = std::move(waiting_[topic].front());
    waiting_[topic].pop_front();
    return ViewFrame{false, message_head(*ids_[topic], message.nanoseconds), message.bytes};
  }
  return std::nullopt;
}

}  // namespace tilth
