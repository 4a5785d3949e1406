#include <utility>

#include <tilth/sources/cloud_inbox.hpp>

namespace tilth {
namespace {

constexpr double kFallBack = 1.0;  // [s]; a cloud that is late by less is only left out

/// Takes messages out of an inbox and watches the stamps of one frame.
class InboxReader {
 public:
  InboxReader(std::shared_ptr<CloudInbox> inbox, InboxReading reading)
      : inbox_(std::move(inbox)), reading_(std::move(reading)) {}

  std::optional<Message> operator()() {
    std::optional<Message> message = inbox_->pop();
    if (!message) return message;
    const auto header = RosMessageReader(message->bytes, reading_.serialization, "PointCloud2").header();
    if (reading_.frame->empty()) *reading_.frame = header.frame_id;
    if (header.frame_id != *reading_.frame) return message;
    if (header.stamp < last_ - kFallBack) {
      reading_.fell_back("the stamps of the clouds fall back by " + std::to_string(last_ - header.stamp) + " s");
      inbox_->close();
      message.reset();
    }
    last_ = header.stamp;
    return message;
  }

 private:
  std::shared_ptr<CloudInbox> inbox_;
  InboxReading reading_;
  double last_ = 0.0;  // [s]
};

}  // namespace

std::string missing_sentence(const InboxCounts& counts) {
  if (counts.missing() == 0) return "";
  std::string text;
  if (counts.dropped > 0) text = "this computer is too slow: " + std::to_string(counts.dropped) + " dropped";
  if (counts.lost > 0)
    text +=
        (text.empty() ? "" : ", ") + std::to_string(counts.lost) + " lost on the way (reliable asks for them again)";
  return text + ", of " + std::to_string(counts.received + counts.lost) + " clouds";
}

void CloudInbox::push(Message message) {
  const std::lock_guard lock(mutex_);
  if (ended_) return;
  ++counts_.received;
  while (waiting_.size() >= depth_) {
    waiting_.pop_front();
    ++counts_.dropped;
  }
  waiting_.push_back(std::move(message));
  changed_.notify_one();
}

void CloudInbox::limit(std::size_t depth) {
  const std::lock_guard lock(mutex_);
  depth_ = depth;
}

void CloudInbox::lose(std::size_t count) {
  const std::lock_guard lock(mutex_);
  counts_.lost += count;
}

std::optional<Message> CloudInbox::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !waiting_.empty() || ended_; });
  if (waiting_.empty()) return std::nullopt;
  std::optional<Message> message(std::move(waiting_.front()));
  waiting_.pop_front();
  return message;
}

void CloudInbox::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void CloudInbox::close() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  waiting_.clear();
  changed_.notify_all();
}

bool CloudInbox::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

InboxCounts CloudInbox::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

CloudFeed feed_of(std::shared_ptr<CloudInbox> inbox, InboxReading reading) {
  CloudFeed feed{
      .name = reading.name, .next = {}, .serialization = reading.serialization, .trust = StampTrust::believed};
  feed.next = InboxReader(std::move(inbox), std::move(reading));
  return feed;
}

}  // namespace tilth
