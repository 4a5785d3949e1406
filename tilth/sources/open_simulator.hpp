// A simulation by name: one of the scenes, or a Gazebo world file; with its own way or a way of the user's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tilth/simulation/simulator.hpp>

namespace tilth {

struct OpenedSimulator {
  SimulationOptions options;             ///< in force
  std::unique_ptr<Simulator> simulator;  ///< never null
  std::vector<std::string> warnings;     ///< what a world file names that was left out
};

/// `scene` is a name of scene_names() or a .world or .sdf file; `values` are those of SimulationOptions. Throws Error
/// on an unknown scene, key or sensor, on a file that cannot be read, and on a world file without a way.
OpenedSimulator open_simulator(const std::string& scene, const OptionValues& values);

}  // namespace tilth
