// The first packets of a sensor, sorted: what the decisions about it are made from.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sensor/packet_clock.hpp>
#include <tilth/sensor/robosense_device.hpp>

namespace tilth {

struct FirstPackets {
  std::vector<DataPacket> data;
  std::optional<DeviceInfo> device;          ///< of the last device packet
  std::optional<RobosenseDevice> robosense;  ///< the same, of a RoboSense
  std::optional<ClockTraits::Mark> mark;     ///< the date that device or position packets told last
};

FirstPackets sorted_packets(std::span<const Packet> first);

}  // namespace tilth
