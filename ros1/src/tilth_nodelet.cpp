// The node as a nodelet: clouds of a driver in the same manager reach it without a way over the network.
#include <memory>
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros_node.hpp"

namespace tilth::ros1 {

class TilthNodelet final : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<RosNode>(getMTNodeHandle(), getMTPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<RosNode> node_;
};

}  // namespace tilth::ros1

PLUGINLIB_EXPORT_CLASS(tilth::ros1::TilthNodelet, nodelet::Nodelet)
