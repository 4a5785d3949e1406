// The file about one unit that a sensor's packets need, or are better with.
#pragma once

#include <filesystem>

#include <tilth/sensor/sensor_file.hpp>

namespace tilth {

/// Throws Error where it cannot be read, as parse_sensor_file.
SensorFile read_sensor_file(const std::filesystem::path& path);

/// The metadata of an Ouster that stand beside `recording`: the .json of the same name, else the only one with angles
/// of beams in it. Empty where there is none, or several.
std::filesystem::path ouster_metadata_beside(const std::filesystem::path& recording);

}  // namespace tilth
