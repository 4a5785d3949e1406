#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/core/lidar_model.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::array<std::string_view, 4> kNames{"leishen_c16", "vlp16", "hdl32", "hdl64"};

/// Sorts the channels, given in the order they fire, into rings from the lowest up.
void set_channels(LidarModel& lidar, std::span<const double> degrees, double channel_period) {
  std::vector<std::size_t> order(degrees.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return degrees[a] < degrees[b]; });
  for (const std::size_t channel : order) {
    lidar.elevations.push_back(degrees[channel] * kDegree);
    lidar.firing_offsets.push_back(double(channel) * channel_period);
  }
}

/// -15, 1, -13, 3 ... -1, 15: lower and upper half take turns.
LidarModel sixteen_beams(double channel_period) {
  std::vector<double> degrees;
  for (int i = 0; i < 8; ++i) degrees.insert(degrees.end(), {-15.0 + 2 * i, 1.0 + 2 * i});
  LidarModel lidar;
  set_channels(lidar, degrees, channel_period);
  return lidar;
}

/// Whole firings that fit into one turn.
std::size_t whole_firings(const LidarModel& lidar) {
  return std::size_t(std::floor(lidar.period / lidar.firing_period + 1e-6));
}

}  // namespace

Eigen::Vector3d LidarModel::direction(std::size_t ring, double time) const {
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

LidarModel vlp16() {
  LidarModel lidar = sixteen_beams(2.304e-6);
  lidar.name = "vlp16";
  lidar.firing_period = 55.296e-6;
  lidar.columns = whole_firings(lidar);
  lidar.min_range = 0.4, lidar.max_range = 100, lidar.range_step = 0.002;
  return lidar;
}

LidarModel leishen_c16() {
  LidarModel lidar = sixteen_beams(3.125e-6);
  lidar.name = "leishen_c16";
  lidar.firing_period = 50e-6;
  lidar.columns = whole_firings(lidar);
  lidar.min_range = 0.4, lidar.max_range = 150, lidar.range_step = 0.0025;
  lidar.centre_radius = 0.0431, lidar.centre_angle = 14.68 * kDegree;
  return lidar;
}

LidarModel hdl32() {
  std::vector<double> degrees;
  for (int i = 0; i < 16; ++i) degrees.insert(degrees.end(), {(-92.0 + 4 * i) / 3, (-28.0 + 4 * i) / 3});
  LidarModel lidar;
  set_channels(lidar, degrees, 1.152e-6);
  lidar.name = "hdl32";
  lidar.firing_period = 46.08e-6;
  lidar.columns = whole_firings(lidar);
  lidar.min_range = 0.9, lidar.max_range = 100, lidar.range_step = 0.002;
  return lidar;
}

LidarModel hdl64() {
  std::vector<double> degrees;
  for (int i = 0; i < 32; ++i) degrees.insert(degrees.end(), {2.0 - i / 3.0, -8.83 - i / 2.0});
  LidarModel lidar;
  set_channels(lidar, degrees, 0.75e-6);
  lidar.name = "hdl64";
  lidar.firing_period = 48e-6;
  lidar.columns = whole_firings(lidar);
  lidar.min_range = 0.9, lidar.max_range = 120, lidar.range_step = 0.002;
  return lidar;
}

std::span<const std::string_view> lidar_names() {
  return kNames;
}

LidarModel make_lidar(std::string_view name) {
  if (name == "leishen_c16") return leishen_c16();
  if (name == "vlp16") return vlp16();
  if (name == "hdl32") return hdl32();
  if (name == "hdl64") return hdl64();
  throw Error("sensor " + std::string(name), "is not known; there are leishen_c16, vlp16, hdl32, hdl64");
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
