// What is fuzzed of sensors: their packets, and the files about them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/sensor/device_packet.hpp>
#include <tilth/sensor/hdl64_status.hpp>
#include <tilth/sensor/ouster_packet.hpp>
#include <tilth/sensor/packet_decoder.hpp>

namespace tilth::fuzz {

using Bytes = std::span<const std::byte>;

inline void require(bool holds) {
  if (!holds) std::abort();
}

inline void check(const Scan& scan, std::size_t beams) {
  require(std::isfinite(scan.stamp) && !scan.cloud.empty() && scan.cloud.has_rings() && scan.cloud.has_times());
  for (const float time : scan.cloud.times) require(time >= 0.0F && std::isfinite(time));
  for (const std::uint16_t ring : scan.cloud.rings) require(ring < beams);
  for (const Eigen::Vector3d& point : scan.cloud.points) require(point.allFinite());
}

inline void decode_all(const std::vector<Packet>& all, const SensorFile& file) {
  const auto decoder = make_packet_decoder(all, {}, file);
  for (const Packet& packet : all) {
    if (const auto scan = decoder->decode(packet)) check(*scan, decoder->rings());
  }
  if (const auto scan = decoder->finish()) check(*scan, decoder->rings());
}

/// Every packet is stored as a byte that `size_of` gives its length for, four of its arrival [ms], and its payload.
template <class F>
std::vector<Packet> stored_packets(Bytes bytes, const F& size_of) {
  std::vector<Packet> all;
  while (bytes.size() > 5) {
    const auto kind = std::to_integer<std::size_t>(bytes[0]);
    std::uint32_t ms = 0;
    std::memcpy(&ms, bytes.data() + 1, sizeof ms);
    const std::size_t size = std::min<std::size_t>(size_of(kind), bytes.size() - 5);
    all.push_back({bytes.subspan(5, size), kind < 128 ? std::optional<double>(ms * 1e-3) : std::nullopt});
    bytes = bytes.subspan(5 + size);
  }
  return all;
}

/// A sensor that needs a file gets one of as many lasers.
inline void packets(Bytes bytes) {
  constexpr std::array<std::size_t, 9> kSizes{1206, 1212, 512, 568, 1080, 1072, 1194, 1262, 1248};
  const std::vector<Packet> all = stored_packets(bytes, [&](std::size_t kind) { return kSizes[kind % kSizes.size()]; });
  SensorFile file;
  for (const std::size_t lasers : {16U, 32U, 40U, 64U}) {
    try {
      decode_all(all, file);
      return;
    } catch (const Error&) {
      file.unit = UnitCalibration{"made", std::vector<LaserCalibration>(lasers)};
    }
  }
  decode_all(all, file);
}

/// The first byte tells the profile of a sensor with 16 beams and 512 columns, four a packet.
inline void ouster(Bytes bytes) {
  if (bytes.empty()) return;
  OusterMetadata metadata;
  metadata.profile = OusterProfile(std::to_integer<unsigned>(bytes[0]) % 4);
  metadata.columns = 512, metadata.columns_a_packet = 4, metadata.window_begin = 500, metadata.window_end = 300;
  metadata.altitudes.assign(16, 0.1), metadata.azimuths.assign(16, 0.05);
  const SensorFile file{"made", metadata, std::nullopt};
  decode_all(stored_packets(bytes.subspan(1), [&](std::size_t) { return packet_size(metadata); }), file);
}

inline void sensor_file(Bytes bytes) {
  const SensorFile file = parse_sensor_file({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "fuzzed");
  require(file.ouster.has_value() != file.unit.has_value());
  if (file.ouster) require(file.ouster->window_size() <= file.ouster->columns && file.ouster->rows() <= 256);
  if (!file.unit) return;
  for (const LaserCalibration& laser : file.unit->lasers)
    require(std::isfinite(laser.elevation) && std::isfinite(laser.offsets.azimuth + laser.offsets.range));
}

/// Pairs of type and value.
inline void hdl64_status(Bytes bytes) {
  std::vector<StatusByte> status;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    status.push_back({std::to_integer<std::uint8_t>(bytes[i]), std::to_integer<std::uint8_t>(bytes[i + 1])});
  if (const auto unit = hdl64_calibration(status)) require(unit->lasers.size() == 64);
}

inline void device_packet(Bytes bytes) {
  const PacketKind kind = kind_of(bytes);
  if (kind == PacketKind::device) {
    for (const double elevation : parse_device_packet(bytes).elevations) require(std::isfinite(elevation));
  }
  if (kind == PacketKind::position) {
    const PositionInfo info = parse_position_packet(bytes);
    require(std::isfinite(info.since_hour) && (!info.utc || std::isfinite(*info.utc)));
  }
}

}  // namespace tilth::fuzz
