// Packets in ROS messages: velodyne_msgs/VelodyneScan, pandar_msgs/PandarScan, the scans and single packets of
// Leishen's drivers, rslidar_msg/RslidarPacket, Ouster's PacketMsg.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/messages/ros_message.hpp>

namespace tilth {

struct StampedPayload {
  double stamp = 0.0;  ///< [s] when the driver got it; 0 where it did not say
  std::span<const std::byte> payload;
};

/// `type` as ROS 1 ("velodyne_msgs/VelodyneScan") or ROS 2 ("velodyne_msgs/msg/VelodyneScan") writes it.
bool is_packet_message(std::string_view type);

/// The frame_id of a message of several packets; empty where messages have none.
std::string packet_message_frame(std::string_view type, std::span<const std::byte> message,
                                 Serialization serialization);

/// The packets, which point into `message`. Throws Error where it is cut or its packets are of no known length.
std::vector<StampedPayload> parse_packet_message(std::string_view type, std::span<const std::byte> message,
                                                 Serialization serialization);

}  // namespace tilth
