#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/core/lidar_model.hpp>

namespace tilth {
namespace {

struct NamedLidar {
  std::string_view name;
  LidarModel (*make)();
};

constexpr std::array kLidars{NamedLidar{"leishen_c16", leishen_c16},
                             NamedLidar{"vlp16", vlp16},
                             NamedLidar{"hdl32", hdl32},
                             NamedLidar{"hdl64", hdl64},
                             NamedLidar{"quanergy_m8", quanergy_m8},
                             NamedLidar{"os1_64", os1_64},
                             NamedLidar{"ruby_128", ruby_128},
                             NamedLidar{"rosette", rosette},
                             NamedLidar{"vlp32c", vlp32c},
                             NamedLidar{"vls128", vls128},
                             NamedLidar{"hdl64_s2", hdl64_s2},
                             NamedLidar{"hdl64_s3", hdl64_s3},
                             NamedLidar{"hesai_xt32", hesai_xt32},
                             NamedLidar{"hesai_pandar64", hesai_pandar64},
                             NamedLidar{"hesai_pandar40p", hesai_pandar40p},
                             NamedLidar{"hesai_qt64", hesai_qt64},
                             NamedLidar{"robosense_rs16", robosense_rs16},
                             NamedLidar{"robosense_helios", robosense_helios}};

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
  const double ahead = azimuths.empty() ? 0.0 : azimuths[ring];
  const double azimuth = -2 * std::numbers::pi * time / period - ahead;
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
  static const auto names = [] {
    std::array<std::string_view, kLidars.size()> all;
    std::transform(kLidars.begin(), kLidars.end(), all.begin(), [](const NamedLidar& lidar) { return lidar.name; });
    return all;
  }();
  return names;
}

LidarModel make_lidar(std::string_view name) {
  std::string known;
  for (const NamedLidar& lidar : kLidars) {
    if (lidar.name == name) return lidar.make();
    known += (known.empty() ? "" : ", ") + std::string(lidar.name);
  }
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
