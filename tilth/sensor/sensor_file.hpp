// What a file says about one unit that its packets do not tell: angles and offsets of its lasers, or all that an Ouster
// sensor says of itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tilth/sensor/ouster_metadata.hpp>
#include <tilth/sensor/unit_calibration.hpp>

namespace tilth {

struct SensorFile {
  std::string name;                      ///< empty: there is no file
  std::optional<OusterMetadata> ouster;  ///< metadata JSON
  std::optional<UnitCalibration> unit;   ///< every other file
};

/// `text` as the maker or its driver writes it: Ouster's metadata (JSON), Velodyne's calibration (db.xml, or the YAML
/// of ROS), a table of elevations and azimuths (Hesai's and RoboSense's .csv). Throws Error naming `name` and what is
/// wrong.
SensorFile parse_sensor_file(std::string_view text, const std::string& name);

}  // namespace tilth
