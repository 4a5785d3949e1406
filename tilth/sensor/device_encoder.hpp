// Device packets (DIFOP) of simulated sensors.
#pragma once

#include <cstddef>
#include <vector>

#include <tilth/core/lidar_model.hpp>
#include <tilth/sensor/packet_format.hpp>

namespace tilth {

/// Leishen (as v2.8/v3.0) and RoboSense.
bool sends_device_packets(PacketFamily family);

/// Speed and the angles of the lasers, as those sensors send them.
std::vector<std::byte> encode_device_packet(const LidarModel& lidar, const PacketFormat& format);

}  // namespace tilth
