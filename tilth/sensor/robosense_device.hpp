// What a RoboSense tells in its device packets (DIFOP, 1248 bytes, big-endian): return mode and the angles of its
// lasers (rs_driver; user manuals of RS-LiDAR-16 and RS-Helios).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <tilth/sensor/packet_writer.hpp>
#include <tilth/sensor/unit_calibration.hpp>

namespace tilth {

struct RobosenseDevice {
  bool dual = false;
  std::optional<UnitCalibration> lasers;   ///< 16 or 32 of RS-LiDAR-32 and RS-Helios; nothing where not set
  std::optional<UnitCalibration> of_rs16;  ///< the same where it is read as an RS-LiDAR-16's
};

/// `payload` has 1248 bytes and is of PacketKind::device.
RobosenseDevice parse_robosense_device(std::span<const std::byte> payload);

/// The angles of `format`, rounded to 0.01 degrees, where that sensor has them in `payload`.
void put_robosense_angles(PacketBytes& payload, const PacketFormat& format);

}  // namespace tilth
