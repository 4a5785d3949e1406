#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/core/lidar_model.hpp>

namespace tilth {
namespace {

constexpr std::array<std::string_view, 8> kNames{"leishen_c16", "vlp16",  "hdl32",    "hdl64",
                                                 "quanergy_m8", "os1_64", "ruby_128", "rosette"};

/// Each of the two wedges bends the beam by half of the greatest angle.
Eigen::Vector3d direction_in_rosette(const LidarModel& lidar, std::size_t ring, double time) {
  constexpr double kFirst = 121.57, kSecond = -77.73;  // [Hz]
  const double first = 2 * std::numbers::pi * kFirst * time, second = 2 * std::numbers::pi * kSecond * time;
  const double half = 0.5 * lidar.rosette_angle;
  const double aside = half * (std::cos(first) + std::cos(second));
  const double up = half * (std::sin(first) + std::sin(second)) + lidar.elevations[ring];
  return {std::cos(up) * std::cos(aside), std::cos(up) * std::sin(aside), std::sin(up)};
}

}  // namespace

Eigen::Vector3d LidarModel::direction(std::size_t ring, double time) const {
  if (rosette_angle > 0) return direction_in_rosette(*this, ring, time);
  const double azimuth = -2 * std::numbers::pi * time / period;
  const double horizontal = std::cos(elevations[ring]);
  return {horizontal * std::cos(azimuth), horizontal * std::sin(azimuth), std::sin(elevations[ring])};
}

Eigen::Vector3d LidarModel::origin(double time) const {
  const double azimuth = -2 * std::numbers::pi * time / period + centre_angle;
  return {centre_radius * std::cos(azimuth), centre_radius * std::sin(azimuth), 0.0};
}

std::size_t LidarModel::ring_of(double elevation) const {
  const auto above = std::lower_bound(elevations.begin(), elevations.end(), elevation);
  if (above == elevations.begin()) return 0;
  if (above == elevations.end()) return rings() - 1;
  const std::size_t ring = std::size_t(above - elevations.begin());
  return elevation - elevations[ring - 1] < elevations[ring] - elevation ? ring - 1 : ring;
}

std::span<const std::string_view> lidar_names() {
  return kNames;
}

LidarModel make_lidar(std::string_view name) {
  if (name == "leishen_c16") return leishen_c16();
  if (name == "vlp16") return vlp16();
  if (name == "hdl32") return hdl32();
  if (name == "hdl64") return hdl64();
  if (name == "quanergy_m8") return quanergy_m8();
  if (name == "os1_64") return os1_64();
  if (name == "ruby_128") return ruby_128();
  if (name == "rosette") return rosette();
  std::string known;
  for (const std::string_view each : kNames) known += (known.empty() ? "" : ", ") + std::string(each);
  throw Error("sensor " + std::string(name), "is not known; there are " + known);
}

LidarModel with_columns(LidarModel lidar, std::size_t columns) {
  if (columns == 0) throw Error("columns", "must be at least 1");
  const double longest = *std::max_element(lidar.firing_offsets.begin(), lidar.firing_offsets.end());
  lidar.columns = columns;
  lidar.firing_period = lidar.period / double(columns);
  if (longest >= lidar.firing_period) throw Error("columns", "leave no time for every beam of the " + lidar.name);
  return lidar;
}

}  // namespace tilth
