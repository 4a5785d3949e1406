// ROS's side of the border (C++17): topics, services and parameters of a node, for a program of its own or a nodelet.
#pragma once

#include <memory>
#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>
#include <vector>

#include "border.hpp"

namespace tilth::ros1 {

/// The topics of a node; messages pass as bytes.
class RosOutlet final : public Outlet {
 public:
  explicit RosOutlet(ros::NodeHandle& own);

  void publish(std::size_t topic, const std::uint8_t* message, std::size_t bytes) override;
  bool wanted(std::size_t topic) override;
  void note(const std::string& sentence) override;
  void warn(const std::string& sentence) override;

  struct Published {
    ros::Publisher publisher;
    topic_tools::ShapeShifter message;  ///< of the topic's type
  };

 private:
  std::vector<Published> topics_;
};

class RosNode {
 public:
  /// Of the topic `points` of `common`, with the parameters, topics and services of `own` (~). Throws std::exception
  /// with the sentence that helps where a parameter is wrong, or the map cannot be read.
  RosNode(ros::NodeHandle common, ros::NodeHandle own);

 private:
  RosOutlet outlet_;
  Node node_;
  std::vector<ros::ServiceServer> services_;
  ros::Subscriber fixed_, guess_, points_;  // last: their callbacks use the members above
};

}  // namespace tilth::ros1
