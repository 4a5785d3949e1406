#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/node/node_work.hpp>
#include <tilth/node/slam_node.hpp>

namespace tilth {

SlamNode::SlamNode(const OptionValues& parameters, NodeOutlet& outlet)
    : work_(std::make_unique<NodeWork>(parameters, outlet)) {}

SlamNode::~SlamNode() = default;

void SlamNode::take(std::vector<std::byte> cloud, std::uint64_t arrival) {
  work_->inbox()->push({0, arrival, std::move(cloud)});
}

void SlamNode::take_static_transforms(std::span<const std::byte> message) {
  work_->take_static_transforms(message);
}

void SlamNode::take_guess(std::span<const std::byte> message) {
  work_->take_guess(message);
}

void SlamNode::lose(std::size_t count) {
  work_->inbox()->lose(count);
}

void SlamNode::reset() {
  work_->inbox()->close();
}

std::string SlamNode::save_map() {
  return work_->ask("save_map", [](NodeTask& task) { return task.save_map(); });
}

std::string SlamNode::localize() {
  return work_->ask("localize", [](NodeTask& task) { return task.localize({}); });
}

SlamNode::Answer SlamNode::serve(const std::string& name) {
  try {
    if (name == "save_map") return {true, save_map()};
    if (name == "localize") return {true, localize()};
    if (name != "reset") throw Error(name, "is no service of this node");
    reset();
    return {true, "begins anew with the next clouds"};
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
}

std::vector<NodeParameter> SlamNode::parameters() {
  return work_->parameters();
}

SlamNode::Answer SlamNode::set(const OptionValues& values) {
  try {
    work_->set(values);
    return {true, ""};
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
}

}  // namespace tilth
