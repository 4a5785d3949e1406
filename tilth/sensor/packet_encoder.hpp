// A scan as the packets its sensor would send: the inverse of packet_decoder, for simulated recordings. A packet begins
// with each turn; blocks left over in the last one are empty.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tilth/core/lidar_model.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/sensor/packet_format.hpp>

namespace tilth {

struct EncodedPacket {
  double sent = 0.0;  ///< [s] after the last shot
  std::vector<std::byte> payload;
};

/// How packets of `lidar` look. Throws Error where there are none (hdl64), or its firings are not spaced as theirs.
PacketFormat packet_format_of(const LidarModel& lidar);

/// The packets of one turn, single return. Throws Error where a point has no ring, no time or the time of no firing.
std::vector<EncodedPacket> encode_scan(const Scan& scan, const LidarModel& lidar, const PacketFormat& format);

/// Leishen's DIFOP with speed and angles, as v2.8/v3.0 sends it.
std::vector<std::byte> encode_device_packet(const LidarModel& lidar, const PacketFormat& format);

/// All that a sensor sends, scan after scan: its data packets, and once a second Leishen's device packet.
class PacketStream {
 public:
  explicit PacketStream(const LidarModel& lidar);  ///< throws Error as packet_format_of

  std::vector<EncodedPacket> encode(const Scan& scan);  ///< in the order they are sent; throws Error as encode_scan
  const PacketFormat& format() const { return format_; }

 private:
  LidarModel lidar_;
  PacketFormat format_;
  double next_device_packet_ = 0.0;  // [s]
};

}  // namespace tilth
