#include "packet_recording.hpp"

#include <tilth/io/output_file.hpp>
#include <tilth/sensor/packet.hpp>

namespace tilth::app {
namespace {

/// As the sensors come from their makers.
UdpRoute route_of(const LidarModel& lidar, std::span<const std::byte> payload) {
  constexpr std::uint32_t kLeishen = 0xC0A801C8, kOther = 0xC0A801C9, kComputer = 0xC0A80166, kAll = 0xFFFFFFFF;
  const std::uint16_t port = factory_port(payload);
  if (!lidar.name.starts_with("leishen")) return {kOther, kAll, port, port};
  constexpr std::uint16_t kBoth = 2368 + 2369;  // each goes out of the port of the other
  return {kLeishen, kComputer, std::uint16_t(kBoth - port), port};
}

}  // namespace

PacketRecording::PacketRecording(const std::filesystem::path& path, const LidarModel& lidar)
    : lidar_(lidar), stream_(lidar), file_(path) {
  const SentFile about = stream_.sensor_file();
  if (!about.extension.empty()) write_text(std::filesystem::path(path).replace_extension(about.extension), about.text);
}

void PacketRecording::write(const Scan& scan) {
  for (const EncodedPacket& packet : stream_.encode(scan))
    file_.write(packet.sent, route_of(lidar_, packet.payload), packet.payload);
}

}  // namespace tilth::app
