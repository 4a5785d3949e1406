// What a sensor tells about itself beside its points: DIFOP of a Leishen or RoboSense (about one a second, big-endian;
// of the latter only the speed: see robosense_device.hpp) and Velodyne's
// position packets, which carry the GPS receiver's sentence.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tilth {

struct DeviceInfo {
  int generation = 0;  ///< 2: v2.6, 3: v2.8 and v3.0, 4, 5; 0: not told
  int revolutions_per_minute = 0;
  std::optional<double> utc;            ///< [s] since 1970, whole seconds; v2.6 to v3.0 with a time service only
  std::array<double, 16> elevations{};  ///< [rad] as calibrated, of each channel; v2.6 to v3.0, 0: not told
};

/// `payload` must be of PacketKind::device.
DeviceInfo parse_device_packet(std::span<const std::byte> payload);

/// Whether the sensor's clock follows a GPS receiver's pulse a second.
enum class PulseState : std::uint8_t { absent, synchronizing, locked, error };

struct PositionInfo {
  double since_hour = 0.0;          ///< [s] of the sensor's clock
  std::optional<double> utc;        ///< [s] since 1970 of the last GPRMC sentence; nothing without a fix
  std::optional<PulseState> pulse;  ///< nothing where the byte has no meaning known
};

/// `payload` must be of PacketKind::position.
PositionInfo parse_position_packet(std::span<const std::byte> payload);

}  // namespace tilth
