#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/sensor/ouster_encoder.hpp>
#include <tilth/sensor/ouster_packet.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kMillimetre = 1e-3;
constexpr double kOffTime = 0.1;  ///< [columns] a point's time may lie off its column

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = std::byte(value >> 8 * i & 0xFF);
}

std::vector<double> in_degrees(std::vector<double> angles) {
  for (double& angle : angles) angle /= kDegree;
  return angles;
}

/// Row by row, in millimetres.
std::vector<double> flat(const Eigen::Isometry3d& transform) {
  std::vector<double> all;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      all.push_back(transform(row, column) * (column == 3 && row < 3 ? 1.0 / kMillimetre : 1.0));
  }
  return all;
}

/// An empty turn: every column is measured.
std::vector<EncodedPacket> empty_turn(double stamp, const OusterMetadata& metadata, std::uint16_t frame) {
  const OusterLayout& layout = layout_of(metadata.profile);
  const std::size_t column_size = layout.column_size(metadata.rows());
  std::vector<EncodedPacket> packets;
  for (std::size_t measurement = 0; measurement < metadata.columns; ++measurement) {
    const std::size_t in_packet = measurement % metadata.columns_a_packet;
    const double time = stamp + double(measurement) * metadata.column_period();
    if (in_packet == 0) packets.push_back({0.0, std::vector<std::byte>(packet_size(metadata))});
    std::vector<std::byte>& payload = packets.back().payload;
    packets.back().sent = time + metadata.column_period();
    const std::size_t at = layout.header + in_packet * column_size;
    put(payload, at, std::uint64_t(std::llround(time * 1e9)), 8);
    put(payload, at + 8, measurement, 2);
    if (metadata.profile == OusterProfile::legacy) {
      put(payload, at + 10, frame, 2);
      put(payload, at + column_size - layout.column_footer, 0xFFFFFFFF, 4);
    } else {
      put(payload, 0, 1, 2), put(payload, 2, frame, 2);
      put(payload, at + 10, 1, 2);
    }
  }
  return packets;
}

void put_pixel(std::vector<std::byte>& payload, std::size_t at, OusterProfile profile, const OusterPixel& pixel) {
  const double unit = profile == OusterProfile::low ? 8 * kMillimetre : kMillimetre;
  const double most = profile == OusterProfile::low ? 0x7FFF : profile == OusterProfile::legacy ? 0xFFFFF : 0x7FFFF;
  const auto range = std::uint64_t(std::clamp(std::round(pixel.range / unit), 0.0, most));
  const auto intensity = std::uint64_t(std::clamp(std::round(pixel.intensity), 0.0F, 255.0F));
  switch (profile) {
    case OusterProfile::low: put(payload, at, range | intensity << 16, 4); break;
    case OusterProfile::dual: put(payload, at, range | intensity << 24, 4); break;
    default: put(payload, at, range, 4), put(payload, at + 4, intensity, 1);
  }
}

}  // namespace

bool sends_as_ouster(const LidarModel& lidar) {
  const auto at_once = [](double offset) { return offset == 0.0; };
  const bool columns = lidar.columns == 512 || lidar.columns == 1024 || lidar.columns == 2048;
  return lidar.name.starts_with("os") && columns && lidar.centre_angle == 0.0 &&
         std::all_of(lidar.firing_offsets.begin(), lidar.firing_offsets.end(), at_once);
}

OusterMetadata ouster_metadata_of(const LidarModel& lidar, OusterProfile profile) {
  OusterMetadata metadata;
  metadata.product = "OS-1-" + std::to_string(lidar.rings()), metadata.firmware = "simulated";
  metadata.profile = profile;
  metadata.columns = lidar.columns, metadata.window_end = lidar.columns - 1;
  metadata.rate = std::round(1.0 / lidar.period);
  metadata.altitudes.assign(lidar.elevations.rbegin(), lidar.elevations.rend());  // the highest beam comes first
  metadata.azimuths.assign(lidar.rings(), 0.0);
  metadata.beam_origin.x() = lidar.centre_radius;
  metadata.T_sensor_lidar.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  metadata.T_sensor_lidar.translation() = Eigen::Vector3d(0, 0, 0.03618);
  return metadata;
}

std::string ouster_metadata_text(const OusterMetadata& m) {
  Eigen::Isometry3d T_lidar_beam = Eigen::Isometry3d::Identity();
  T_lidar_beam.translation() = m.beam_origin;
  nlohmann::ordered_json root;
  root["sensor_info"] = {{"prod_line", m.product}, {"prod_sn", m.serial}, {"build_rev", m.firmware}};
  root["beam_intrinsics"] = {{"beam_altitude_angles", in_degrees(m.altitudes)},
                             {"beam_azimuth_angles", in_degrees(m.azimuths)},
                             {"beam_to_lidar_transform", flat(T_lidar_beam)},
                             {"lidar_origin_to_beam_origin_mm", m.beam_origin.x() / kMillimetre}};
  root["lidar_intrinsics"] = {{"lidar_to_sensor_transform", flat(m.T_sensor_lidar)}};
  root["lidar_data_format"] = {{"columns_per_frame", m.columns},
                               {"columns_per_packet", m.columns_a_packet},
                               {"pixels_per_column", m.rows()},
                               {"column_window", {m.window_begin, m.window_end}},
                               {"pixel_shift_by_row", std::vector<int>(m.rows(), 0)},
                               {"udp_profile_lidar", name_of(m.profile)}};
  root["config_params"] = {{"lidar_mode", std::to_string(m.columns) + "x" + std::to_string(int(m.rate))}};
  return root.dump(2) + "\n";
}

std::vector<EncodedPacket> encode_ouster_scan(const Scan& scan, const LidarModel& lidar, const OusterMetadata& metadata,
                                              std::uint16_t frame) {
  const PointCloud& cloud = scan.cloud;
  if (!cloud.has_rings() || !cloud.has_times())
    throw Error("scan", "has no rings and times, so packets cannot hold it");
  const OusterLayout& layout = layout_of(metadata.profile);
  std::vector<EncodedPacket> packets = empty_turn(scan.stamp, metadata, frame);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double firing = cloud.times[i] / lidar.firing_period, column = std::round(firing);
    if (!(std::abs(firing - column) < kOffTime && column >= 0.0 && column < double(lidar.columns)) ||
        cloud.rings[i] >= lidar.rings())
      throw Error("scan", "has a point of no beam of " + lidar.name + ", or of a time at which none fires");
    const std::size_t row = lidar.rings() - 1 - cloud.rings[i], at_once = metadata.columns_a_packet;
    const std::size_t at = layout.header + std::size_t(column) % at_once * layout.column_size(metadata.rows()) +
                           layout.column_header + row * layout.pixel;
    const double range = (cloud.points[i] - lidar.origin(cloud.times[i])).norm() + metadata.beam_origin.norm();
    const float intensity = i < cloud.intensities.size() ? cloud.intensities[i] : 0.0F;
    put_pixel(packets[std::size_t(column) / at_once].payload, at, metadata.profile, {range, intensity});
  }
  return packets;
}

}  // namespace tilth
