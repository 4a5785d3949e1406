// Messages of a topic on their way to who registers them: never waits for him, keeps the newest, counts what made way.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include <tilth/io/recording.hpp>

namespace tilth {

struct InboxCounts {
  std::size_t received = 0;
  std::size_t dropped = 0;  ///< of these, those that made way
  std::size_t lost = 0;     ///< beside these, those that never came
};

class CloudInbox {
 public:
  /// At most `depth` messages wait; then the oldest makes way.
  explicit CloudInbox(std::size_t depth) : depth_(depth) {}

  void push(Message message);

  /// The middleware says that so many were lost on the way.
  void lose(std::size_t count);

  /// Waits for the next message; nothing once it is closed.
  std::optional<Message> pop();

  /// From now on there is nothing: what waits is let go.
  void close();

  bool closed() const;
  InboxCounts counts() const;

 private:
  std::size_t depth_;
  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<Message> waiting_;
  InboxCounts counts_;
  bool closed_ = false;
};

}  // namespace tilth
