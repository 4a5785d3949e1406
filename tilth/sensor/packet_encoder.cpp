#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/sensor/device_encoder.hpp>
#include <tilth/sensor/ouster_encoder.hpp>
#include <tilth/sensor/packet_encoder.hpp>
#include <tilth/sensor/packet_writer.hpp>

namespace tilth {
namespace {

constexpr double kSpacing = 1e-3;  ///< relative, of firings: 1.3 us over a packet
constexpr double kOffTime = 0.1;   ///< [firings] a point's time may lie off its firing

PacketEcho echo_of(double range, float intensity, double unit) {
  const double units = std::clamp(std::round(range / unit), 0.0, 65535.0);
  return {std::uint16_t(units), std::uint8_t(std::clamp(std::round(intensity), 0.0F, 255.0F))};
}

/// Every shot of the turn in the order they are fired, without return where there is no point.
std::vector<PacketEcho> shots_of(const Scan& scan, const LidarModel& lidar, const PacketFormat& format) {
  const PointCloud& cloud = scan.cloud;
  if (!cloud.has_rings() || !cloud.has_times())
    throw Error("scan", "has no rings and times, so packets cannot hold it");
  std::vector<std::size_t> channel_of(format.channels());
  for (std::size_t channel = 0; channel < format.channels(); ++channel) channel_of[format.rings[channel]] = channel;
  std::vector<PacketEcho> shots(lidar.columns * format.channels());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t ring = cloud.rings[i];
    if (ring >= lidar.rings()) throw Error("scan", "has ring " + std::to_string(ring) + " of " + lidar.name);
    const double firing = (cloud.times[i] - lidar.firing_offsets[ring]) / lidar.firing_period;
    const double column = std::round(firing);
    if (!(std::abs(firing - column) < kOffTime && column >= 0.0 && column < double(lidar.columns)))
      throw Error("scan", "has a time at which no beam of " + lidar.name + " fires");
    const double range = (cloud.points[i] - lidar.origin(cloud.times[i])).norm();
    const float intensity = i < cloud.intensities.size() ? cloud.intensities[i] : 0.0F;
    shots[std::size_t(column) * format.channels() + channel_of[ring]] = echo_of(range, intensity, format.unit);
  }
  return shots;
}

/// An HDL-64E's own table, all of whose lasers are where the model has them.
UnitCalibration calibration_of(const PacketFormat& format) {
  UnitCalibration unit{format.name, {}};
  for (const double elevation : format.elevations) unit.lasers.push_back({elevation, {}});
  return unit;
}

/// As Hesai writes the angles of a unit.
std::string angle_table(const PacketFormat& format) {
  std::string text = "Channel,Elevation,Azimuth\n";
  for (std::size_t i = 0; i < format.channels(); ++i) {
    char row[64];
    const double azimuth = format.offsets.empty() ? 0.0 : format.offsets[i].azimuth;
    std::snprintf(row, sizeof row, "%zu,%.6f,%.6f\n", i + 1, format.elevations[i] * 180.0 / std::numbers::pi,
                  azimuth * 180.0 / std::numbers::pi);
    text += row;
  }
  return text;
}

}  // namespace

PacketFormat packet_format_of(const LidarModel& lidar) {
  std::string known = "leishen_c16, os1_64";
  for (const PacketFormat& format : packet_formats()) {
    const bool named = format.name == lidar.name || (lidar.name == "leishen_c16" && format.name == "leishen_c16_v3");
    const auto& lidars = lidar_names();
    if (std::find(lidars.begin(), lidars.end(), format.name) != lidars.end()) known += ", " + format.name;
    if (!named) continue;
    if (std::abs(lidar.firing_period / format.firing_period - 1.0) > kSpacing)
      throw Error("columns", "packets of " + lidar.name + " hold no other number of firings a turn than its own");
    return format;
  }
  throw Error("sensor " + lidar.name, "has no packets that are known; there are those of " + known);
}

std::vector<EncodedPacket> encode_scan(const Scan& scan, const LidarModel& lidar, const PacketFormat& format) {
  std::vector<PacketEcho> shots = shots_of(scan, lidar, format);
  const PacketLayout& layout = format.layout();
  const std::size_t firings = layout.column_shots() / format.channels();
  const std::size_t columns = (lidar.columns + firings - 1) / firings;
  // The model counts from the first laser that fires, the packet from where the head stands.
  const double lead = std::max(0.0, -*std::min_element(format.channel_times.begin(), format.channel_times.end()));
  shots.resize(columns * layout.column_shots());
  std::vector<EncodedPacket> packets;
  for (std::size_t column = 0; column < columns; ++column) {
    const double time = double(column * firings) * lidar.firing_period + lead;
    const std::size_t in_packet = column % layout.columns(false);
    if (in_packet == 0) {
      packets.push_back({scan.stamp + time + format.last_shot(false), PacketBytes(layout.size)});
      put_header(packets.back().payload, format);
      put_tail(packets.back().payload, format, scan.stamp + time + format.stamp_offset(false));
    }
    for (std::size_t bank = 0; bank < layout.banks; ++bank) {
      const std::size_t first = column * layout.column_shots() + bank * layout.slots;
      put_block(packets.back().payload, layout, in_packet * layout.banks + bank, time / lidar.period * kAzimuthsATurn,
                std::span(shots).subspan(first, layout.slots));
    }
  }
  return packets;
}

PacketStream::PacketStream(const LidarModel& lidar) : lidar_(lidar) {
  if (sends_as_ouster(lidar)) {
    ouster_ = ouster_metadata_of(lidar, OusterProfile::single);
    return;
  }
  format_ = packet_format_of(lidar);
  if (format_.family == PacketFamily::velodyne_64)
    status_ = hdl64_status_bytes(calibration_of(format_), format_.name == "hdl64_s3");
}

SentFile PacketStream::sensor_file() const {
  if (ouster_) return {".json", ouster_metadata_text(*ouster_)};
  const bool tells = format_.family == PacketFamily::velodyne_64 || sends_device_packets(format_.family);
  return format_.needs_calibration && !tells ? SentFile{".csv", angle_table(format_)} : SentFile{};
}

std::vector<EncodedPacket> PacketStream::encode(const Scan& scan) {
  constexpr double kSecond = 1.0;
  if (ouster_) return encode_ouster_scan(scan, lidar_, *ouster_, std::uint16_t(next_++));
  std::vector<EncodedPacket> packets = encode_scan(scan, lidar_, format_);
  for (EncodedPacket& packet : packets) {
    if (status_.empty()) break;
    const StatusByte byte = status_[next_++ % status_.size()];
    packet.payload[format_.layout().time + 4] = std::byte(byte.type);
    packet.payload[format_.layout().time + 5] = std::byte(byte.value);
  }
  if (!sends_device_packets(format_.family) || scan.stamp < next_device_packet_) return packets;
  packets.insert(packets.begin(), EncodedPacket{scan.stamp, encode_device_packet(lidar_, format_)});
  next_device_packet_ = scan.stamp + kSecond;
  return packets;
}

}  // namespace tilth
