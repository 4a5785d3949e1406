// Which sensor sent these packets, and how they are to be read: decided over the first second or two of a recording
// from length, model byte, device packets and the step of the clock, because families share size and header.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/sensor/clock_convention.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sensor/sensor_file.hpp>

namespace tilth {

struct PacketConvention {
  PacketFormat format;  ///< with the angles that the sensor told, where it did
  bool dual = false;    ///< as the first packets are
  ClockConvention clock;
  std::vector<std::string> decisions;  ///< one sentence each
};

/// `sensor` is the beginning of a name of packet_formats(), or empty; `file` tells of the unit. Throws Error where no
/// packet is of kind data, no sensor fits, or `file` is of another one.
PacketConvention recognise_packets(std::span<const Packet> first, std::string_view sensor, const SensorFile& file = {});

}  // namespace tilth
