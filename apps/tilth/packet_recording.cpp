#include "packet_recording.hpp"

#include <tilth/sensor/packet.hpp>

namespace tilth::app {
namespace {

// As the sensors come from their makers.
constexpr UdpRoute kVelodyne{0xC0A801C9, 0xFFFFFFFF, 2368, 2368};
constexpr UdpRoute kLeishen{0xC0A801C8, 0xC0A80166, 2369, 2368};
constexpr UdpRoute kLeishenDevice{0xC0A801C8, 0xC0A80166, 2368, 2369};

}  // namespace

void PacketRecording::write(const Scan& scan) {
  const UdpRoute& data = stream_.format().tail == PacketTail::velodyne ? kVelodyne : kLeishen;
  for (const EncodedPacket& packet : stream_.encode(scan)) {
    const bool device = kind_of(packet.payload) == PacketKind::device;
    file_.write(packet.sent, device ? kLeishenDevice : data, packet.payload);
  }
}

}  // namespace tilth::app
