// libtilth_ros2, found and loaded where clouds of a topic are asked for: Tilth itself needs no ROS.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tilth/sources/ros2_interface.hpp>

namespace tilth {

/// Where it is looked for: beside the program, in LD_LIBRARY_PATH, in lib of AMENT_PREFIX_PATH.
std::vector<std::filesystem::path> ros2_library_folders();

/// `file`; empty: the first in those folders. It stays loaded. Throws Error where there is none, it cannot be loaded
/// because ROS 2 is not set up, or it is of another version of Tilth.
const TilthRos2Library& load_ros2_library(const std::string& file);

}  // namespace tilth
