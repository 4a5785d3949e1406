// A scan as the packets its sensor would send: the inverse of packet_decoder, for simulated recordings. A packet begins
// with each turn; blocks left over in the last one are empty.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/lidar_model.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/sensor/encoded_packet.hpp>
#include <tilth/sensor/hdl64_status.hpp>
#include <tilth/sensor/ouster_metadata.hpp>
#include <tilth/sensor/packet_format.hpp>

namespace tilth {

/// How packets of `lidar` look. Throws Error where there are none, or its firings are not spaced as theirs.
PacketFormat packet_format_of(const LidarModel& lidar);

/// The packets of one turn, single return. Throws Error where a point has no ring, no time or the time of no firing.
std::vector<EncodedPacket> encode_scan(const Scan& scan, const LidarModel& lidar, const PacketFormat& format);

/// A file that belongs to packets.
struct SentFile {
  std::string extension;  ///< ".json"; empty: none is needed
  std::string text;
};

/// All that a sensor sends, scan after scan: its data packets, once a second the device packet of a Leishen or
/// RoboSense, and in the status bytes of an HDL-64E its calibration.
class PacketStream {
 public:
  explicit PacketStream(const LidarModel& lidar);  ///< throws Error as packet_format_of

  std::vector<EncodedPacket> encode(const Scan& scan);  ///< in the order they are sent; throws Error as encode_scan
  SentFile sensor_file() const;                         ///< about the unit, where its packets mean nothing without

 private:
  LidarModel lidar_;
  std::optional<OusterMetadata> ouster_;
  PacketFormat format_;              // unless it is an Ouster
  double next_device_packet_ = 0.0;  // [s]
  std::vector<StatusByte> status_;   // of an HDL-64E
  std::size_t next_ = 0;             // of these, or turn of an Ouster
};

}  // namespace tilth
