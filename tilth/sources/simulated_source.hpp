// Scans made as they are asked for: sim://SCENE?key=value&key=value, with the keys of `tilth simulate --set`; SCENE may
// be a Gazebo world file: sim://room.sdf?waypoints=0,0;5,0.
#pragma once

#include <memory>
#include <string>

#include <tilth/sources/scan_source.hpp>

namespace tilth {

inline const std::string kSimulatedScheme = "sim://";

/// Throws Error on an unknown scene or sensor, and on a key that is unknown, is no number or breaks its bounds.
std::unique_ptr<ScanSource> open_simulation(const std::string& uri);

}  // namespace tilth
