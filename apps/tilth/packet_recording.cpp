#include "packet_recording.hpp"

namespace tilth::app {
namespace {

// As the sensors come from their makers.
constexpr UdpRoute kVelodyne{0xC0A801C9, 0xFFFFFFFF, 2368, 2368};
constexpr UdpRoute kLeishen{0xC0A801C8, 0xC0A80166, 2369, 2368};
constexpr UdpRoute kLeishenDevice{0xC0A801C8, 0xC0A80166, 2368, 2369};
constexpr double kSecond = 1.0;

}  // namespace

PacketRecording::PacketRecording(const std::filesystem::path& path, const LidarModel& lidar)
    : lidar_(lidar), format_(packet_format_of(lidar)), file_(path) {}

void PacketRecording::write(const Scan& scan) {
  const bool leishen = format_.tail != PacketTail::velodyne;
  if (leishen && scan.stamp >= next_device_packet_) {
    file_.write(scan.stamp, kLeishenDevice, encode_device_packet(lidar_, format_));
    next_device_packet_ = scan.stamp + kSecond;
  }
  for (const EncodedPacket& packet : encode_scan(scan, lidar_, format_)) {
    file_.write(packet.sent, leishen ? kLeishen : kVelodyne, packet.payload);
  }
}

}  // namespace tilth::app
