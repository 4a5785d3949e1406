// The sensors whose lasers are listed in lidar_channels.hpp.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tilth/core/lidar_channels.hpp>
#include <tilth/core/lidar_model.hpp>

namespace tilth {
namespace {

/// A sensor but for its lasers.
struct SpinTraits {
  const char* name;
  double firing_us;             // [us] from one firing of all lasers to the next
  double range_step;            // [m]
  double min_range, max_range;  // [m]
  double centre_radius = 0.0;   // [m]
};

LidarModel spinning(const SpinTraits& traits, const LidarChannels& channels) {
  constexpr double kDegree = std::numbers::pi / 180, kMicrosecond = 1e-6;
  std::vector<std::size_t> order(channels.elevations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return channels.elevations[a] < channels.elevations[b]; });
  LidarModel lidar;
  const double lead = std::max(0.0, -*std::min_element(channels.times.begin(), channels.times.end()));
  for (const std::size_t channel : order) {
    lidar.elevations.push_back(channels.elevations[channel] * kDegree);
    lidar.firing_offsets.push_back((channels.times[channel] + lead) * kMicrosecond);
    if (!channels.azimuths.empty()) lidar.azimuths.push_back(channels.azimuths[channel] * kDegree);
  }
  lidar.name = traits.name;
  lidar.firing_period = traits.firing_us * kMicrosecond;
  lidar.columns = std::size_t(std::floor(lidar.period / lidar.firing_period + 1e-6));
  lidar.centre_radius = traits.centre_radius;
  lidar.min_range = traits.min_range, lidar.max_range = traits.max_range, lidar.range_step = traits.range_step;
  return lidar;
}

}  // namespace

LidarModel vlp32c() {
  return spinning({"vlp32c", 55.296, 0.004, 1.0, 200}, vlp32c_channels());
}

LidarModel vls128() {
  return spinning({"vls128", 53.3, 0.004, 0.5, 220}, vls128_channels(2.665));
}

LidarModel hdl64_s2() {
  return spinning({"hdl64_s2", 48.0, 0.002, 0.9, 120}, hdl64_s2_channels());
}

LidarModel hdl64_s3() {
  return spinning({"hdl64_s3", 57.6, 0.002, 0.9, 120}, hdl64_s3_channels());
}

LidarModel hesai_xt32() {
  return spinning({"hesai_xt32", 50.0, 0.004, 0.05, 120}, hesai_xt32_channels());
}

LidarModel hesai_pandar64() {
  return spinning({"hesai_pandar64", 55.56, 0.004, 0.3, 200}, hesai_pandar64_channels());
}

LidarModel hesai_pandar40p() {
  return spinning({"hesai_pandar40p", 55.56, 0.004, 0.3, 200}, hesai_pandar40p_channels());
}

LidarModel hesai_qt64() {
  return spinning({"hesai_qt64", 500.0 / 3.0, 0.004, 0.1, 60}, hesai_qt64_channels());
}

LidarModel robosense_rs16() {
  return spinning({"robosense_rs16", 55.5, 0.005, 0.4, 150, 0.03825}, rs16_channels());
}

LidarModel robosense_helios() {
  return spinning({"robosense_helios", 55.56, 0.0025, 0.2, 150, 0.03498}, helios_channels());
}

}  // namespace tilth
