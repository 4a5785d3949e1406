// What `ros2 param` asks: parameters listed, described and, those that may be set while the node runs, set.
#pragma once

#include <memory>
#include <vector>

#include "typed_service.hpp"
#include <tilth/node/slam_node.hpp>

namespace tilth::ros2 {

/// The services about the parameters of `slam`, which must outlive them, and use_sim_time.
std::vector<std::unique_ptr<ServiceServer>> parameter_services(RclNode& node, SlamNode& slam, bool use_sim_time);

}  // namespace tilth::ros2
