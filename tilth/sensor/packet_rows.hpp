// The rows of packet_formats(), maker by maker.
#pragma once

#include <vector>

#include <tilth/core/lidar_channels.hpp>
#include <tilth/sensor/packet_format.hpp>

namespace tilth {

/// A row but for its lasers; times in microseconds, the optical centre in metres and degrees.
struct FormatRow {
  const char *name, *title;
  PacketFamily family;
  std::vector<std::uint8_t> models;
  double firing_us, unit;
  double radius = 0.0, angle = 0.0;
};

PacketFormat format_of(const FormatRow& row, const LidarChannels& channels);

/// Lasers at those elevations [deg] that fire `channel_us` [us] after one another.
LidarChannels evenly_fired(std::vector<double> elevations, double channel_us);

std::vector<PacketFormat> velodyne_rows();
std::vector<PacketFormat> leishen_rows();
std::vector<PacketFormat> hesai_rows();
std::vector<PacketFormat> robosense_rows();

}  // namespace tilth
