// tilth_node: a SlamNode (tilth/node) on rcl, and so on whatever middleware the user runs. docs/ros.md.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <diagnostic_msgs/msg/diagnostic_array.h>
#include <exception>
#include <functional>
#include <geometry_msgs/msg/pose_with_covariance_stamped.h>
#include <nav_msgs/msg/odometry.h>
#include <nav_msgs/msg/path.h>
#include <rcutils/logging_macros.h>
#include <rosgraph_msgs/msg/clock.h>
#include <sensor_msgs/msg/point_cloud2.h>
#include <std_srvs/srv/trigger.h>
#include <tf2_msgs/msg/tf_message.h>

#include "parameter_services.hpp"
#include "start_parameters.hpp"
#include <tilth/core/error.hpp>
#include <tilth/messages/ros_message.hpp>
#include <tilth/node/node_options.hpp>
#include <tilth/node/slam_node.hpp>

namespace tilth::ros2 {
namespace {

TILTH_ROS2_SERVICE(std_srvs, Trigger);

constexpr std::int64_t kLongestWait = 100'000'000;  // [ns]
constexpr std::size_t kLeastDepth = 10;             // of clouds that came at once

volatile std::sig_atomic_t interrupted = 0;

const rosidl_message_type_support_t* type_of(NodeTopic topic) {
  switch (topic) {
    case NodeTopic::odometry: return ROSIDL_GET_MSG_TYPE_SUPPORT(nav_msgs, msg, Odometry);
    case NodeTopic::tf:
    case NodeTopic::tf_static: return ROSIDL_GET_MSG_TYPE_SUPPORT(tf2_msgs, msg, TFMessage);
    case NodeTopic::path: return ROSIDL_GET_MSG_TYPE_SUPPORT(nav_msgs, msg, Path);
    case NodeTopic::scan:
    case NodeTopic::map: return ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, PointCloud2);
    case NodeTopic::pose: return ROSIDL_GET_MSG_TYPE_SUPPORT(geometry_msgs, msg, PoseWithCovarianceStamped);
    case NodeTopic::diagnostics: break;
  }
  return ROSIDL_GET_MSG_TYPE_SUPPORT(diagnostic_msgs, msg, DiagnosticArray);
}

/// A hundred of what comes with every scan and is small are kept for those who are slow to hear.
rmw_qos_profile_t quality_of(const PublishedTopic& topic) {
  const bool large = topic.topic == NodeTopic::scan || topic.topic == NodeTopic::path;
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.depth = large ? 10 : 100;
  if (topic.latched) qos.depth = 1, qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  return qos;
}

class RclOutlet final : public NodeOutlet {
 public:
  explicit RclOutlet(RclNode& node) : node_(node) {
    for (const PublishedTopic& topic : node_topics())
      topics_.push_back(std::make_unique<MessagePublisher>(node, type_of(topic.topic), topic.name, quality_of(topic)));
  }

  void publish(NodeTopic topic, std::span<const std::byte> message) override {
    try {
      of(topic).publish(message);
    } catch (const Error& error) {
      warn(error.what());  // a message less: the run goes on
    }
  }
  Serialization serialization() const override { return Serialization::cdr; }
  bool wanted(NodeTopic topic) override { return of(topic).listeners() > 0; }
  void note(const std::string& sentence) override { RCUTILS_LOG_INFO_NAMED(node_.logger(), "%s", sentence.c_str()); }
  void warn(const std::string& sentence) override { RCUTILS_LOG_WARN_NAMED(node_.logger(), "%s", sentence.c_str()); }

 private:
  MessagePublisher& of(NodeTopic topic) { return *topics_[std::size_t(topic)]; }

  RclNode& node_;
  std::vector<std::unique_ptr<MessagePublisher>> topics_;  // by NodeTopic
};

rmw_qos_profile_t latched() {
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.depth = 100, qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  return qos;
}

/// What comes in: clouds, the clock of a simulation or recording, and what services are asked for.
class Inlet {
 public:
  Inlet(RclNode& node, bool use_sim_time, SlamNode& slam, RclOutlet& outlet)
      : node_(node), sim_time_(use_sim_time), slam_(slam), outlet_(outlet) {
    const std::vector<NodeParameter> known = slam.parameters();
    const auto value = [&](const std::string& key) {
      return std::find_if(known.begin(), known.end(), [&](const NodeParameter& p) { return p.key == key; })->value;
    };
    rmw_qos_profile_t qos = rmw_qos_profile_sensor_data;
    qos.depth = 1;
    if (sim_time_)
      listen(ROSIDL_GET_MSG_TYPE_SUPPORT(rosgraph_msgs, msg, Clock), "/clock", qos,
             [this](auto time, auto&) { time_ = RosMessageReader(time, Serialization::cdr, "Clock").time("clock"); });
    if (value("mount_from_tf") == "true")
      listen(type_of(NodeTopic::tf_static), "/tf_static", latched(),
             [this](auto fixed, auto&) { slam_.take_static_transforms(fixed); });
    listen(type_of(NodeTopic::pose), "initialpose", rmw_qos_profile_default,
           [this](auto guess, auto&) { slam_.take_guess(guess); });
    qos.depth = std::max(kLeastDepth, std::stoul(value("queue")));
    if (value("reliable") == "true") qos.reliability = RMW_QOS_POLICY_RELIABILITY_RELIABLE;
    listen(type_of(NodeTopic::scan), "points", qos, [this](auto cloud, auto& points) {
      slam_.lose(points.lost());
      slam_.take(std::move(cloud), now());
    });
    services_ = parameter_services(node, slam, sim_time_);
    for (const char* name : SlamNode::kServices) add_trigger(name);
  }

  /// Hands over what comes, until the program is interrupted.
  void run() {
    WaitSet waiting(node_, heard_.size(), services_.size());
    std::vector<const rcl_subscription_t*> subscriptions;
    std::vector<const rcl_service_t*> services;
    for (const Heard& heard : heard_) subscriptions.push_back(heard.subscription->get());
    for (const auto& service : services_) services.push_back(service->get());
    while (interrupted == 0) {
      try {
        if (waiting.wait(subscriptions, services, kLongestWait)) hand_over();
      } catch (const Error& error) {
        outlet_.warn(error.what());
      }
    }
  }

 private:
  using Take = std::function<void(std::vector<std::byte>, MessageSubscription&)>;
  struct Heard {
    std::unique_ptr<MessageSubscription> subscription;
    Take take;
  };

  void listen(const rosidl_message_type_support_t* type, const char* topic, const rmw_qos_profile_t& qos, Take take) {
    heard_.push_back({std::make_unique<MessageSubscription>(node_, type, topic, qos), std::move(take)});
  }

  void add_trigger(const std::string& name) {
    services_.push_back(
        std::make_unique<TypedService<TriggerService>>(node_, "~/" + name, [this, name](const auto&, auto& response) {
          const SlamNode::Answer answer = slam_.serve(name);
          response.success = answer.success;
          assign(response.message, answer.message);
        }));
  }

  void hand_over() {
    for (const Heard& heard : heard_)
      for (auto message = heard.subscription->take(); !message.empty(); message = heard.subscription->take())
        heard.take(std::move(message), *heard.subscription);
    for (const auto& service : services_) service->answer();
  }

  std::uint64_t now() const {
    if (sim_time_) return std::uint64_t(time_ * 1e9);
    rcutils_time_point_value_t time = 0;
    check(rcutils_system_time_now(&time), "clock");
    return std::uint64_t(time);
  }

  RclNode& node_;
  bool sim_time_;
  SlamNode& slam_;
  RclOutlet& outlet_;
  double time_ = 0.0;  // [s] of /clock
  std::vector<Heard> heard_;
  std::vector<std::unique_ptr<ServiceServer>> services_;
};

}  // namespace
}  // namespace tilth::ros2

int main(int count, char** arguments) {
  using namespace tilth::ros2;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
  try {
    RclNode node(count, arguments, "tilth");
    const StartParameters parameters = read_parameters(node);
    RclOutlet outlet(node);
    tilth::SlamNode slam(parameters.values, outlet);
    Inlet(node, parameters.use_sim_time, slam, outlet).run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tilth_node: %s\n", error.what());
    return 1;
  }
  return 0;
}
