// The sensors that are known by name.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/core/lidar_model.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

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

LidarModel quanergy_m8() {
  constexpr std::array degrees{-18.22, -15.18, -12.15, -9.12, -6.08, -3.04, 0.0, 3.2};
  LidarModel lidar;
  set_channels(lidar, degrees, 2.3e-6);
  lidar.name = "quanergy_m8";
  lidar.firing_period = 38.4e-6;
  lidar.columns = whole_firings(lidar);
  lidar.min_range = 0.5, lidar.max_range = 150, lidar.range_step = 0.002;
  return lidar;
}

LidarModel os1_64() {
  constexpr int kBeams = 64;
  constexpr double kView = 33.2;
  std::vector<double> degrees;
  for (int i = 0; i < kBeams; ++i) degrees.push_back(kView * (0.5 - double(i) / (kBeams - 1)));
  LidarModel lidar;
  set_channels(lidar, degrees, 0);
  lidar.name = "os1_64";
  lidar.columns = 1024;
  lidar.firing_period = lidar.period / double(lidar.columns);
  lidar.min_range = 0.3, lidar.max_range = 120, lidar.range_step = 0.001;
  lidar.centre_radius = 0.0158;
  return lidar;
}

LidarModel ruby_128() {
  constexpr double kMiddle = 0.11;
  constexpr int kInMiddle = 103;
  constexpr std::array above{0.16, 0.19, 0.26, 0.3, 0.35, 0.39, 0.5, 0.6, 0.85, 1.28, 2.05, 3.25};
  constexpr std::array below{5.42, 3.54, 2.48, 1.82, 1.4, 1.1, 0.89, 0.71, 0.49, 0.3, 0.2, 0.16};
  std::vector<double> rising{-25.0};
  for (const double step : below) rising.push_back(rising.back() + step);
  for (int i = 0; i < kInMiddle; ++i) rising.push_back(rising.back() + kMiddle);
  for (const double step : above) rising.push_back(rising.back() + step);
  std::vector<double> degrees;  // as they fire: eight combs one after another
  for (std::size_t comb = 0; comb < 8; ++comb) {
    for (std::size_t i = comb; i < rising.size(); i += 8) degrees.push_back(rising[i]);
  }
  LidarModel lidar;
  set_channels(lidar, degrees, 0.4e-6);
  lidar.name = "ruby_128";
  lidar.firing_period = lidar.period / 1800;
  lidar.columns = whole_firings(lidar);
  lidar.min_range = 0.4, lidar.max_range = 200, lidar.range_step = 0.005;
  return lidar;
}

LidarModel rosette() {
  constexpr std::array degrees{-0.9, -0.54, -0.18, 0.18, 0.54, 0.9};
  LidarModel lidar;
  set_channels(lidar, degrees, 0.1e-6);
  lidar.name = "rosette";
  lidar.columns = 4000;
  lidar.firing_period = lidar.period / double(lidar.columns);
  lidar.min_range = 0.5, lidar.max_range = 200, lidar.range_step = 0.001;
  lidar.rosette_angle = 34.0 * kDegree;
  return lidar;
}

}  // namespace tilth
