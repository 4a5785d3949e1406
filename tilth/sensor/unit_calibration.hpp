// The angles and offsets of one unit, as its maker measured them: of files and of packets that tell them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tilth/sensor/packet_format.hpp>

namespace tilth {

struct LaserCalibration {
  double elevation = 0.0;  ///< [rad]
  LaserOffsets offsets;
};

struct UnitCalibration {
  std::string origin;                    ///< where it comes from: a file's name, or "its packets"
  std::vector<LaserCalibration> lasers;  ///< in the order of the packet's channels
};

/// Velodyne's db.xml (degrees, centimetres), the YAML that ROS's velodyne_pointcloud makes of it (radians, metres), or
/// rows of (laser from 1,) elevation and azimuth [deg] between commas, as Hesai and RoboSense write them. Throws Error
/// naming `name` and what is wrong.
UnitCalibration parse_unit_calibration(std::string_view text, const std::string& name);

/// `format` with the angles and offsets of the unit. Throws Error naming `unit.origin` where it has another number of
/// lasers, or angles that no laser of such a sensor has (5 degrees off the table, where the sensor has one).
PacketFormat calibrated(PacketFormat format, const UnitCalibration& unit);

}  // namespace tilth
