// Parameters of the node as it starts, from the command line and parameter files.
#pragma once

#include "rcl_handles.hpp"
#include <tilth/core/options.hpp>

namespace tilth::ros2 {

struct StartParameters {
  OptionValues values;  ///< as SlamNode takes them
  bool use_sim_time = false;
};

/// Those that are meant for the node. Throws Error for a list, which none of its parameters is.
StartParameters read_parameters(RclNode& node);

}  // namespace tilth::ros2
