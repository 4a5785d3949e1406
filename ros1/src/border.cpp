// Tilth's side of the border (C++20).
#include "border.hpp"

#include <tilth/node/node_options.hpp>
#include <tilth/node/parameter_value.hpp>
#include <tilth/node/slam_node.hpp>

namespace tilth::ros1 {
namespace {

/// The other side's, as a SlamNode takes it.
class Carried final : public NodeOutlet {
 public:
  explicit Carried(Outlet& outlet) : outlet_(outlet) {}

  Serialization serialization() const override { return Serialization::ros1; }
  void publish(NodeTopic topic, std::span<const std::byte> message) override {
    outlet_.publish(std::size_t(topic), reinterpret_cast<const std::uint8_t*>(message.data()), message.size());
  }
  bool wanted(NodeTopic topic) override { return outlet_.wanted(std::size_t(topic)); }
  void note(const std::string& sentence) override { outlet_.note(sentence); }
  void warn(const std::string& sentence) override { outlet_.warn(sentence); }

 private:
  Outlet& outlet_;
};

std::size_t queue_of(const Parameters& parameters) {
  for (const NodeParameter& option : node_parameters(parameters))
    if (option.key == "queue") return std::size_t(number_of(option));
  return 0;
}

}  // namespace

struct Node::Inside {
  Inside(const Parameters& parameters, Outlet& o) : outlet(o), queue(queue_of(parameters)), slam(parameters, outlet) {}
  Carried outlet;
  std::size_t queue;
  SlamNode slam;
};

Node::Node(const Parameters& parameters, Outlet& outlet) : inside_(std::make_unique<Inside>(parameters, outlet)) {}

Node::~Node() = default;

void Node::take(const std::uint8_t* cloud, std::size_t bytes, std::uint64_t arrival) {
  const auto* begin = reinterpret_cast<const std::byte*>(cloud);
  inside_->slam.take({begin, begin + bytes}, arrival);
}

void Node::take_static_transforms(const std::uint8_t* message, std::size_t bytes) {
  inside_->slam.take_static_transforms({reinterpret_cast<const std::byte*>(message), bytes});
}

void Node::take_guess(const std::uint8_t* message, std::size_t bytes) {
  inside_->slam.take_guess({reinterpret_cast<const std::byte*>(message), bytes});
}

std::size_t Node::queue() const {
  return inside_->queue;
}

std::vector<std::string> Node::services() {
  return {SlamNode::kServices.begin(), SlamNode::kServices.end()};
}

Node::Answer Node::serve(const std::string& service) {
  SlamNode::Answer answer = inside_->slam.serve(service);
  return {answer.success, std::move(answer.message)};
}

std::vector<Topic> topics() {
  std::vector<Topic> all;
  for (const PublishedTopic& topic : node_topics()) {
    const std::size_t slash = topic.type.find('/'), name = topic.type.rfind('/');  // about "msg"
    all.push_back({topic.name, topic.type.substr(0, slash) + topic.type.substr(name), topic.latched});
  }
  return all;
}

std::string parameter_text(double value) {
  return tilth::parameter_text(value);
}

}  // namespace tilth::ros1
