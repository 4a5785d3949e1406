// Parameters of the node: read once, as it starts, from the command line and parameter files; listed and described by
// the services that `ros2 param` asks. They are not changed while it runs.
#pragma once

#include <memory>
#include <vector>

#include "typed_service.hpp"
#include <tilth/core/options.hpp>

namespace tilth::ros2 {

struct StartParameters {
  OptionValues values;  ///< as SlamNode takes them
  bool use_sim_time = false;
};

/// Those that are meant for the node. Throws Error for a list, which none of its parameters is.
StartParameters read_parameters(RclNode& node);

/// The services about the `known` parameters and use_sim_time.
std::vector<std::unique_ptr<ServiceServer>> parameter_services(RclNode& node, std::vector<OptionInfo> known,
                                                               bool use_sim_time);

}  // namespace tilth::ros2
