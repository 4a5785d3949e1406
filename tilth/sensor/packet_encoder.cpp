#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sensor/packet_encoder.hpp>

namespace tilth {
namespace {

constexpr double kSpacing = 1e-3;  ///< relative, of firings: 1.3 us over a packet
constexpr double kOffTime = 0.1;   ///< [firings] a point's time may lie off its firing

struct Shot {
  std::uint16_t distance = 0;  // [units]
  std::uint8_t intensity = 0;
};

void put_little(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = std::byte(value >> 8 * i & 0xFF);
}

void put_big(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value) {
  bytes[at] = std::byte(value >> 8 & 0xFF), bytes[at + 1] = std::byte(value & 0xFF);
}

Shot shot_of(double range, float intensity, double unit) {
  const double units = std::clamp(std::round(range / unit), 0.0, 65535.0);
  return {std::uint16_t(units), std::uint8_t(std::clamp(std::round(intensity), 0.0F, 255.0F))};
}

/// Every shot of the turn in the order they are fired, without return where there is no point.
std::vector<Shot> shots_of(const Scan& scan, const LidarModel& lidar, const PacketFormat& format) {
  const PointCloud& cloud = scan.cloud;
  if (!cloud.has_rings() || !cloud.has_times())
    throw Error("scan", "has no rings and times, so packets cannot hold it");
  std::vector<std::size_t> channel_of(format.channels());
  for (std::size_t channel = 0; channel < format.channels(); ++channel) channel_of[format.rings[channel]] = channel;
  std::vector<Shot> shots(lidar.columns * format.channels());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t ring = cloud.rings[i];
    if (ring >= lidar.rings()) throw Error("scan", "has ring " + std::to_string(ring) + " of " + lidar.name);
    const double firing = (cloud.times[i] - lidar.firing_offsets[ring]) / lidar.firing_period;
    const double column = std::round(firing);
    if (!(std::abs(firing - column) < kOffTime && column >= 0.0 && column < double(lidar.columns)))
      throw Error("scan", "has a time at which no beam of " + lidar.name + " fires");
    const double range = (cloud.points[i] - lidar.origin(cloud.times[i])).norm();
    const float intensity = i < cloud.intensities.size() ? cloud.intensities[i] : 0.0F;
    shots[std::size_t(column) * format.channels() + channel_of[ring]] = shot_of(range, intensity, format.unit);
  }
  return shots;
}

void put_block(std::vector<std::byte>& payload, std::size_t block, double azimuth, std::span<const Shot> shots) {
  const PacketLayout& layout = layout_of(PacketTail::velodyne);
  const std::size_t at = block * layout.block_size();
  payload[at] = std::byte(0xFF), payload[at + 1] = std::byte(0xEE);
  put_little(payload, at + 2, std::uint32_t(std::fmod(std::round(azimuth), kAzimuthsATurn)), 2);
  for (std::size_t slot = 0; slot < shots.size(); ++slot) {
    const std::size_t shot = at + layout.block_header + slot * layout.slot_size;
    put_little(payload, shot, shots[slot].distance, 2);
    payload[shot + 2] = std::byte(shots[slot].intensity);
  }
}

void put_tail(EncodedPacket& packet, const PacketFormat& format, double first_shot) {
  constexpr std::uint8_t kStrongest = 0x37;
  const double stamp = std::fmod(first_shot + format.stamp_offset(false), 3600.0);
  const PacketLayout& layout = format.layout();
  put_little(packet.payload, layout.time, std::uint32_t(std::llround(stamp * 1e6) % 3'600'000'000), 4);
  packet.payload[layout.mode] = std::byte(kStrongest);
  packet.payload[layout.model] = std::byte(format.models.front());
  packet.sent = first_shot + format.last_shot(false);
}

}  // namespace

PacketFormat packet_format_of(const LidarModel& lidar) {
  for (const PacketFormat& format : packet_formats()) {
    const bool named = format.name == lidar.name || (lidar.name == "leishen_c16" && format.name == "leishen_c16_v3");
    if (!named) continue;
    if (std::abs(lidar.firing_period / format.firing_period - 1.0) > kSpacing)
      throw Error("columns", "packets of " + lidar.name + " hold no other number of firings a turn than its own");
    return format;
  }
  throw Error("sensor " + lidar.name, "has no packets that are known; there are those of leishen_c16, vlp16, hdl32");
}

std::vector<EncodedPacket> encode_scan(const Scan& scan, const LidarModel& lidar, const PacketFormat& format) {
  std::vector<Shot> shots = shots_of(scan, lidar, format);
  const std::size_t slots = format.layout().slots, blocks_a_packet = format.layout().blocks;
  const std::size_t firings = slots / format.channels();
  const std::size_t blocks = (lidar.columns + firings - 1) / firings;
  shots.resize(blocks * slots);
  std::vector<EncodedPacket> packets;
  for (std::size_t block = 0; block < blocks; ++block) {
    const double time = lidar.time_of(block * firings, format.rings.front());
    if (block % blocks_a_packet == 0) {
      packets.push_back({0.0, std::vector<std::byte>(format.layout().size)});
      put_tail(packets.back(), format, scan.stamp + time);
    }
    put_block(packets.back().payload, block % blocks_a_packet, time / lidar.period * kAzimuthsATurn,
              std::span(shots).subspan(block * slots, slots));
  }
  return packets;
}

std::vector<std::byte> encode_device_packet(const LidarModel& lidar, const PacketFormat& format) {
  constexpr std::array<std::uint8_t, 8> kMagic{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  constexpr std::size_t kSpeed = 8, kAngles = 245, kGeneration = 1196;
  std::vector<std::byte> payload(1206);
  for (std::size_t i = 0; i < kMagic.size(); ++i) payload[i] = std::byte(kMagic[i]);
  put_big(payload, kSpeed, std::uint32_t(std::lround(60.0 / lidar.period)));
  for (std::size_t channel = 0; channel < format.channels(); ++channel) {
    const double angle = format.elevations[channel] * 18000.0 / std::numbers::pi;
    put_big(payload, kAngles + 2 * channel, std::uint32_t(std::lround(angle)) & 0xFFFF);
  }
  payload[kGeneration] = std::byte(3);
  return payload;
}

PacketStream::PacketStream(const LidarModel& lidar) : lidar_(lidar), format_(packet_format_of(lidar)) {}

std::vector<EncodedPacket> PacketStream::encode(const Scan& scan) {
  constexpr double kSecond = 1.0;
  std::vector<EncodedPacket> packets = encode_scan(scan, lidar_, format_);
  if (format_.tail == PacketTail::velodyne || scan.stamp < next_device_packet_) return packets;
  packets.insert(packets.begin(), EncodedPacket{scan.stamp, encode_device_packet(lidar_, format_)});
  next_device_packet_ = scan.stamp + kSecond;
  return packets;
}

}  // namespace tilth
