#include <array>
#include <cmath>
#include <numbers>

#include <tilth/sensor/device_encoder.hpp>
#include <tilth/sensor/packet_writer.hpp>
#include <tilth/sensor/robosense_device.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSpeed = 8;

PacketBytes begun_packet(std::size_t size, const LidarModel& lidar) {
  constexpr std::array<std::uint8_t, 8> kMagic{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  PacketBytes payload(size);
  for (std::size_t i = 0; i < kMagic.size(); ++i) payload[i] = std::byte(kMagic[i]);
  put_big(payload, kSpeed, std::uint64_t(std::lround(60.0 / lidar.period)), 2);
  return payload;
}

}  // namespace

bool sends_device_packets(PacketFamily family) {
  return family == PacketFamily::leishen_1206 || family == PacketFamily::robosense ||
         family == PacketFamily::robosense_helios;
}

std::vector<std::byte> encode_device_packet(const LidarModel& lidar, const PacketFormat& format) {
  if (format.family != PacketFamily::leishen_1206) {
    PacketBytes payload = begun_packet(format.layout().size, lidar);
    put_robosense_angles(payload, format);
    return payload;
  }
  constexpr std::size_t kAngles = 245, kGeneration = 1196;
  PacketBytes payload = begun_packet(1206, lidar);
  for (std::size_t channel = 0; channel < format.channels(); ++channel) {
    const double angle = format.elevations[channel] * 18000.0 / std::numbers::pi;
    put_big(payload, kAngles + 2 * channel, std::uint64_t(std::lround(angle)) & 0xFFFF, 2);
  }
  payload[kGeneration] = std::byte(3);
  return payload;
}

}  // namespace tilth
