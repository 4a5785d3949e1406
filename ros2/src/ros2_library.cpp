// libtilth_ros2: the clouds of a topic for a program that loads this (tilth/sources/ros2_interface.hpp).
#include <exception>
#include <optional>
#include <rcl/graph.h>
#include <sensor_msgs/msg/point_cloud2.h>

#include "rcl_handles.hpp"
#include <tilth/sources/ros2_interface.hpp>

namespace tilth::ros2 {
namespace {

constexpr const char* kCloud = "sensor_msgs/msg/PointCloud2";

/// Who sends a topic to whom this listens.
std::string senders_of(RclNode& node, const std::string& topic, bool reliable) {
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_topic_endpoint_info_array_t all = rcl_get_zero_initialized_topic_endpoint_info_array();
  check(rcl_get_publishers_info_by_topic(node.get(), &allocator, topic.c_str(), false, &all), "topic " + topic);
  std::string text = all.size == 0 ? "nobody sends it" : "who sends it is silent";
  for (std::size_t i = 0; i < all.size; ++i) {
    const rcl_topic_endpoint_info_t& sender = all.info_array[i];
    const std::string name = sender.node_name, type = sender.topic_type;
    if (type != kCloud) text = name + " sends " + type + ", expected " + kCloud;
    if (reliable && sender.qos_profile.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT)
      text = name + " sends best effort, which who asks for reliable does not hear";
  }
  check(rcl_topic_endpoint_info_array_fini(&all, &allocator), "topic " + topic);
  return text;
}

/// A node, and the topic that it listens to.
class CloudTopic {
 public:
  CloudTopic(const char* topic, bool reliable, std::size_t depth)
      : node_(0, nullptr, "tilth_live"), reliable_(reliable) {
    rmw_qos_profile_t qos = rmw_qos_profile_sensor_data;
    qos.depth = depth;
    if (reliable) qos.reliability = RMW_QOS_POLICY_RELIABILITY_RELIABLE;
    clouds_.emplace(node_, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, PointCloud2), topic, qos);
    waiting_.emplace(node_, 1, 0);
  }

  /// Whether a cloud came.
  bool next(int milliseconds, TilthRos2Cloud& to) {
    bytes_ = clouds_->take();
    const rcl_subscription_t* const one[] = {clouds_->get()};
    if (bytes_.empty() && waiting_->wait(one, {}, 1'000'000LL * milliseconds)) bytes_ = clouds_->take();
    to = {reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size(), clouds_->lost()};
    return !bytes_.empty();
  }

  std::string senders() { return senders_of(node_, clouds_->topic(), reliable_); }

 private:
  RclNode node_;
  bool reliable_;
  std::optional<MessageSubscription> clouds_;
  std::optional<WaitSet> waiting_;
  std::vector<std::byte> bytes_;
};

}  // namespace
}  // namespace tilth::ros2

struct TilthRos2Topic {
  std::optional<tilth::ros2::CloudTopic> topic;
  std::string problem, text;

  /// Calls `f`; what that throws is the problem from now on.
  template <class F>
  void guarded(const F& f) {
    try {
      f();
    } catch (const std::exception& error) {
      problem = error.what();
    }
  }
};

namespace {

TilthRos2Topic* open_topic(const char* name, bool reliable, std::size_t depth) {
  auto* opened = new TilthRos2Topic;
  opened->guarded([&] { opened->topic.emplace(name, reliable, depth); });
  return opened;
}

int next_cloud(TilthRos2Topic* from, int milliseconds, TilthRos2Cloud* to) {
  bool came = false;
  if (from->topic) from->guarded([&] { came = from->topic->next(milliseconds, *to); });
  return from->problem.empty() ? int(came) : -1;
}

const char* text_of(TilthRos2Topic* of) {
  if (of->topic && of->problem.empty()) of->guarded([&] { of->text = of->topic->senders(); });
  return of->problem.empty() ? of->text.c_str() : of->problem.c_str();
}

void close_topic(TilthRos2Topic* topic) {
  delete topic;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const TilthRos2Library* tilth_ros2_library_1() {
  static constexpr TilthRos2Library kLibrary{open_topic, next_cloud, text_of, close_topic};
  return &kLibrary;
}
