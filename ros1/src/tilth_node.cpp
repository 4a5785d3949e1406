// tilth_node: the node as a program of its own. docs/ros.md.
#include <cstdio>
#include <exception>

#include "ros_node.hpp"

int main(int count, char** arguments) {
  ros::init(count, arguments, "tilth");
  try {
    const tilth::ros1::RosNode node{ros::NodeHandle(), ros::NodeHandle("~")};
    ros::MultiThreadedSpinner(2).spin();  // clouds come also while a service is at work
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tilth_node: %s\n", error.what());
    return 1;
  }
  return 0;
}
