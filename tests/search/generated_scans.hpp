// Scans of a spinning LiDAR in plain places, for tests and benchmarks of the search: rays against the planes of a box,
// with range noise, missing returns, isolated outliers, and both usual orders of storage.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include <tilth/core/point_cloud.hpp>

namespace tilth::generated {

/// Half sizes of the place [m] around the sensor; infinite where it is open.
struct Place {
  double x = 4.0, y = 3.0, floor = 1.0, ceiling = 1.5;
};
inline constexpr Place kRoom{};
inline constexpr Place kCorridor{25.0, 1.0, 0.6, 2.0};
inline constexpr Place kOpenGround{1e9, 1e9, 1.2, 1e9};

struct ScanShape {
  Place place;
  int rings = 16;
  int columns = 1800;
  int overlap = 0;                        ///< columns beyond a whole turn
  double lowest = -15.0, highest = 15.0;  ///< [deg] elevation
  double noise = 0.02;                    ///< [m] of range
  double missing = 0.01;                  ///< share of rays without return
  double outliers = 0.003;                ///< share of rays that end anywhere
  double max_range = 80.0;                ///< [m]
  bool ring_major = false;
  bool clockwise = true;
};

inline double wall_range(const Place& place, const Eigen::Vector3d& ray) {
  double range = std::numeric_limits<double>::infinity();
  const auto hit = [&](double direction, double negative, double positive) {
    if (direction != 0.0) range = std::min(range, direction > 0.0 ? positive / direction : -negative / direction);
  };
  hit(ray.x(), place.x, place.x);
  hit(ray.y(), place.y, place.y);
  hit(ray.z(), place.floor, place.ceiling);
  return range;
}

inline PointCloud make_scan(const ScanShape& s, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, s.noise);
  std::uniform_real_distribution<double> ratio(0.0, 1.0);
  PointCloud cloud;
  const int columns = s.columns + s.overlap;
  for (int n = 0; n < columns * s.rings; ++n) {
    const int ring = s.ring_major ? n / columns : n % s.rings;
    const int column = s.ring_major ? n % columns : n / s.rings;
    const double turn = 2.0 * std::numbers::pi * (column + 0.1 * ring / s.rings + 0.37) / s.columns;
    const double azimuth = s.clockwise ? 1.0 - turn : 1.0 + turn;
    const double step = s.rings > 1 ? (s.highest - s.lowest) / (s.rings - 1) : 0.0;
    const double elevation = (s.lowest + step * ring) * std::numbers::pi / 180.0;
    const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
    double range = wall_range(s.place, ray);
    if (range > s.max_range || ratio(random) < s.missing) continue;
    range += noise(random);
    if (ratio(random) < s.outliers) range *= ratio(random);
    cloud.points.push_back(ray * range);
    cloud.rings.push_back(std::uint16_t(ring));
  }
  return cloud;
}

}  // namespace tilth::generated
