#include "ros_node.hpp"

#include <algorithm>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Trigger.h>
#include <stdexcept>
#include <tf2_msgs/TFMessage.h>

namespace tilth::ros1 {
namespace {

constexpr std::size_t kLeastDepth = 10;  // of clouds that came at once
constexpr std::uint32_t kKept = 100;     // messages for those who are slow to hear

/// Parameters in groups become "group.name".
void flatten(const std::string& name, XmlRpc::XmlRpcValue& value, Parameters& to) {
  using Value = XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case Value::TypeBoolean: to[name] = bool(value) ? "true" : "false"; return;
    case Value::TypeInt: to[name] = std::to_string(int(value)); return;
    case Value::TypeDouble: to[name] = parameter_text(double(value)); return;
    case Value::TypeString: to[name] = std::string(value); return;
    case Value::TypeStruct:
      for (auto& [key, inner] : value) flatten(name.empty() ? key : name + "." + key, inner, to);
      return;
    default: throw std::runtime_error("parameter " + name + ": is a list: expected one value");
  }
}

Parameters read_parameters(const ros::NodeHandle& own) {
  Parameters parameters;
  XmlRpc::XmlRpcValue all;
  if (own.getParam(own.getNamespace(), all)) flatten("", all, parameters);
  return parameters;
}

template <class Message>
RosOutlet::Published published(ros::NodeHandle& own, const std::string& name, bool latched) {
  namespace traits = ros::message_traits;
  topic_tools::ShapeShifter message;
  message.morph(traits::md5sum<Message>(), traits::datatype<Message>(), traits::definition<Message>(), "");
  return {own.advertise<Message>(name, latched ? 1 : kKept, latched), std::move(message)};
}

RosOutlet::Published published(ros::NodeHandle& own, const Topic& topic) {
  const std::string name = topic.name.rfind("~/", 0) == 0 ? topic.name.substr(2) : topic.name;
  if (topic.type == "nav_msgs/Odometry") return published<nav_msgs::Odometry>(own, name, topic.latched);
  if (topic.type == "nav_msgs/Path") return published<nav_msgs::Path>(own, name, topic.latched);
  if (topic.type == "tf2_msgs/TFMessage") return published<tf2_msgs::TFMessage>(own, name, topic.latched);
  if (topic.type == "sensor_msgs/PointCloud2") return published<sensor_msgs::PointCloud2>(own, name, topic.latched);
  if (topic.type == "geometry_msgs/PoseWithCovarianceStamped")
    return published<geometry_msgs::PoseWithCovarianceStamped>(own, name, topic.latched);
  return published<diagnostic_msgs::DiagnosticArray>(own, name, topic.latched);
}

/// `take` gets messages of that type as bytes.
template <class Message, class Take>
ros::Subscriber subscribed(ros::NodeHandle& to, const std::string& topic, std::size_t queue, Take take) {
  using Any = topic_tools::ShapeShifter;
  const auto unpack = [take](const Any::ConstPtr& message) {
    std::vector<std::uint8_t> bytes(message->size());
    ros::serialization::OStream stream(bytes.data(), std::uint32_t(bytes.size()));
    message->write(stream);
    take(bytes.data(), bytes.size());
  };
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const Any::ConstPtr&>(topic, std::uint32_t(queue), unpack);
  options.md5sum = ros::message_traits::md5sum<Message>();
  options.datatype = ros::message_traits::datatype<Message>();
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return to.subscribe(options);
}

}  // namespace

RosOutlet::RosOutlet(ros::NodeHandle& own) {
  for (const Topic& topic : topics()) topics_.push_back(published(own, topic));
}

void RosOutlet::publish(std::size_t topic, const std::uint8_t* message, std::size_t bytes) {
  Published& to = topics_.at(topic);
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(message), std::uint32_t(bytes));  // it only reads
  to.message.read(stream);
  to.publisher.publish(to.message);
}

bool RosOutlet::wanted(std::size_t topic) {
  return topics_.at(topic).publisher.getNumSubscribers() > 0;
}

void RosOutlet::note(const std::string& sentence) {
  ROS_INFO_STREAM(sentence);
}

void RosOutlet::warn(const std::string& sentence) {
  ROS_WARN_STREAM(sentence);
}

RosNode::RosNode(ros::NodeHandle common, ros::NodeHandle own) : outlet_(own), node_(read_parameters(own), outlet_) {
  using Trigger = std_srvs::Trigger;
  for (const std::string& name : Node::services()) {
    const boost::function<bool(Trigger::Request&, Trigger::Response&)> answer = [this, name](auto&, auto& response) {
      const Node::Answer given = node_.serve(name);
      response.success = given.success;
      response.message = given.message;
      return true;
    };
    services_.push_back(own.advertiseService(name, answer));
  }
  const auto take_fixed = [this](const auto* data, std::size_t bytes) { node_.take_static_transforms(data, bytes); };
  const auto take_guess = [this](const auto* data, std::size_t bytes) { node_.take_guess(data, bytes); };
  const auto take = [this](const auto* data, std::size_t bytes) { node_.take(data, bytes, ros::Time::now().toNSec()); };
  fixed_ = subscribed<tf2_msgs::TFMessage>(common, "/tf_static", kKept, take_fixed);
  guess_ = subscribed<geometry_msgs::PoseWithCovarianceStamped>(common, "initialpose", kKept, take_guess);
  points_ = subscribed<sensor_msgs::PointCloud2>(common, "points", std::max(kLeastDepth, node_.queue()), take);
}

}  // namespace tilth::ros1
