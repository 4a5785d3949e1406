#include <utility>

#include <tilth/node/cloud_inbox.hpp>

namespace tilth {

void CloudInbox::push(Message message) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  ++counts_.received;
  if (waiting_.size() >= depth_) {
    waiting_.pop_front();
    ++counts_.dropped;
  }
  waiting_.push_back(std::move(message));
  changed_.notify_one();
}

void CloudInbox::lose(std::size_t count) {
  const std::lock_guard lock(mutex_);
  counts_.lost += count;
}

std::optional<Message> CloudInbox::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !waiting_.empty() || closed_; });
  if (closed_) return std::nullopt;
  std::optional<Message> message(std::move(waiting_.front()));
  waiting_.pop_front();
  return message;
}

void CloudInbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  waiting_.clear();
  changed_.notify_all();
}

bool CloudInbox::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

InboxCounts CloudInbox::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace tilth
