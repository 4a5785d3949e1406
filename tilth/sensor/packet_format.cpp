#include <algorithm>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include <tilth/sensor/packet_format.hpp>
#include <tilth/sensor/packet_rows.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMicrosecond = 1e-6;
constexpr double kHesaiLead = 6.0;  ///< [us] from the time of the packet to the first shot of its last firing
constexpr double kPandar64Stamp = 42.58, kPandar40pStamp = 28.58;  ///< [us] from the last azimuth (tier4/nebula)
constexpr double kQt64Lead = 35.71;                                ///< [us] to the first azimuth (tier4/nebula)
constexpr double kVls128Stamp = 8.7;  ///< [us] from the first shot to the time of the packet (ros-drivers/velodyne)

std::vector<PacketFormat> all_rows() {
  std::vector<PacketFormat> all;
  for (std::vector<PacketFormat> rows : {velodyne_rows(), leishen_rows(), hesai_rows(), robosense_rows()})
    std::move(rows.begin(), rows.end(), std::back_inserter(all));
  return all;
}

}  // namespace

PacketFormat format_of(const FormatRow& row, const LidarChannels& channels) {
  PacketFormat format;
  format.name = row.name, format.title = row.title, format.family = row.family, format.models = row.models;
  format.firing_period = row.firing_us * kMicrosecond, format.unit = row.unit;
  format.centre_radius = row.radius, format.centre_angle = row.angle * kDegree;
  for (const double time : channels.times) format.channel_times.push_back(time * kMicrosecond);
  for (const double azimuth : channels.azimuths) format.offsets.push_back({.azimuth = azimuth * kDegree});
  std::vector<double> elevations;
  for (const double elevation : channels.elevations) elevations.push_back(elevation * kDegree);
  return with_elevations(std::move(format), std::move(elevations));
}

LidarChannels evenly_fired(std::vector<double> elevations, double channel_us) {
  LidarChannels channels{std::move(elevations), {}, {}};
  for (std::size_t i = 0; i < channels.elevations.size(); ++i) channels.times.push_back(double(i) * channel_us);
  return channels;
}

double PacketFormat::stamp_offset(bool dual) const {
  const double last_column = packet_period(dual) - column_period();
  switch (family) {
    case PacketFamily::velodyne:
    case PacketFamily::velodyne_64:
    case PacketFamily::robosense:
    case PacketFamily::robosense_helios: return 0.0;
    case PacketFamily::velodyne_128: return kVls128Stamp * kMicrosecond;
    case PacketFamily::hesai_568:
    case PacketFamily::hesai_xt32: return last_column - kHesaiLead * kMicrosecond;
    case PacketFamily::hesai_64: return last_column + kPandar64Stamp * kMicrosecond;
    case PacketFamily::hesai_40p: return last_column + kPandar40pStamp * kMicrosecond;
    case PacketFamily::hesai_qt64: return -kQt64Lead * kMicrosecond;
    default: return last_shot(dual);
  }
}

std::span<const PacketFormat> packet_formats() {
  static const std::vector<PacketFormat> rows = all_rows();
  return rows;
}

PacketFormat with_elevations(PacketFormat format, std::vector<double> elevations) {
  std::vector<std::size_t> order(elevations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return elevations[a] < elevations[b]; });
  format.rings.resize(order.size());
  for (std::size_t ring = 0; ring < order.size(); ++ring) format.rings[order[ring]] = std::uint16_t(ring);
  format.elevations = std::move(elevations);
  return format;
}

}  // namespace tilth
