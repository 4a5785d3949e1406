// Messages of a topic on their way to who registers them: never waits for him, keeps the newest, counts what made way.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <tilth/io/recording.hpp>
#include <tilth/sources/cloud_source.hpp>

namespace tilth {

struct InboxCounts {
  std::size_t received = 0;
  std::size_t dropped = 0;  ///< of these, those that made way
  std::size_t lost = 0;     ///< beside these, those that never came

  std::size_t missing() const { return dropped + lost; }
};

/// What is missing, as a sentence; empty: nothing.
std::string missing_sentence(const InboxCounts& counts);

class CloudInbox {
 public:
  /// At most `depth` messages wait; then the oldest makes way.
  explicit CloudInbox(std::size_t depth) : depth_(depth) {}

  void limit(std::size_t depth);  ///< from the next message on

  void push(Message message);

  /// The middleware says that so many were lost on the way.
  void lose(std::size_t count);

  /// Waits for the next message; nothing once it has ended.
  std::optional<Message> pop();

  void end();    ///< nothing more comes, but what waits is still popped
  void close();  ///< nor is what waits

  bool ended() const;
  InboxCounts counts() const;

 private:
  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::size_t depth_;
  std::deque<Message> waiting_;
  InboxCounts counts_;
  bool ended_ = false;
};

/// What is done with the clouds of an inbox.
struct InboxReading {
  std::string name;                    ///< of the topic
  std::shared_ptr<std::string> frame;  ///< that is read; where it is empty, it becomes that of the first message
  Serialization serialization = Serialization::cdr;
  std::function<void(const std::string&)> fell_back;  ///< hears of stamps that fall back, as a sentence
};

/// Messages of the inbox, to its end, or until the stamps of the frame fall back by more than a second, as where a
/// recording is played again: then it is closed.
CloudFeed feed_of(std::shared_ptr<CloudInbox> inbox, InboxReading reading);

}  // namespace tilth
