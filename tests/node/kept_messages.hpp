// What a node hands out, kept and read again.
#pragma once

#include <bit>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <tilth/core/se3.hpp>
#include <tilth/messages/ros_message.hpp>
#include <tilth/node/node_outlet.hpp>

namespace tilth {

/// Keeps what a node hands out.
class Kept final : public NodeOutlet {
 public:
  explicit Kept(Serialization serialization = Serialization::cdr) : serialization_(serialization) {}

  void publish(NodeTopic topic, std::span<const std::byte> message) override {
    const std::lock_guard lock(mutex_);
    messages_[topic].emplace_back(message.begin(), message.end());
    changed_.notify_all();
  }
  Serialization serialization() const override { return serialization_; }
  bool wanted(NodeTopic) override { return true; }
  void note(const std::string&) override {}
  void warn(const std::string& sentence) override {
    const std::lock_guard lock(mutex_);
    warnings_ += sentence + "\n";
    changed_.notify_all();
  }

  std::vector<std::vector<std::byte>> wait_for(NodeTopic topic, std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(120), [&] { return messages_[topic].size() >= count; });
    return messages_[topic];
  }
  std::string wait_for_warning() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(120), [&] { return !warnings_.empty(); });
    return warnings_;
  }

 private:
  Serialization serialization_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<NodeTopic, std::vector<std::vector<std::byte>>> messages_;
  std::string warnings_;
};

struct ReadTransform {
  double stamp = 0.0;
  std::string parent, child;
  Eigen::Vector3d translation;
  Eigen::Quaterniond rotation;
};

inline ReadTransform read_transform(RosMessageReader& reader) {
  ReadTransform t;
  const RosMessageReader::Header header = reader.header();
  t.stamp = header.stamp, t.parent = header.frame_id, t.child = reader.text("child");
  const auto number = [&] { return std::bit_cast<double>(reader.number<std::uint64_t>("number")); };
  for (int i = 0; i < 3; ++i) t.translation[i] = number();
  for (int i = 0; i < 4; ++i) t.rotation.coeffs()[i] = number();
  return t;
}

inline std::vector<ReadTransform> read_tf(const std::vector<std::byte>& message) {
  RosMessageReader reader(message, Serialization::cdr, "TFMessage");
  std::vector<ReadTransform> all(reader.number<std::uint32_t>("transforms"));
  for (ReadTransform& t : all) t = read_transform(reader);
  return all;
}

}  // namespace tilth
