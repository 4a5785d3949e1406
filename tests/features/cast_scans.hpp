// Scans of a sensor of 16 beams at rest, by casting rays at planes and poles whose place is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <tilth/core/point_cloud.hpp>

namespace tilth::cast {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr double kDegree = std::numbers::pi / 180.0;

/// [m] along a unit ray from the sensor to a surface, or kNothing.
using Surface = std::function<double(const Eigen::Vector3d& ray)>;
using Surfaces = std::vector<Surface>;
using Part = std::function<bool(const Eigen::Vector3d& point)>;

/// The plane of all points p with normal . p = -distance: `normal` points to the sensor. Only where `part` says so.
inline Surface plane(const Eigen::Vector3d& normal, double distance, const Part& part = {}) {
  return [=](const Eigen::Vector3d& ray) {
    const double range = -distance / normal.dot(ray);
    return range > 0 && (!part || part(range * ray)) ? range : kNothing;
  };
}

/// An upright cylinder without ends.
inline Surface pole(double x, double y, double radius) {
  return [=](const Eigen::Vector3d& ray) {
    const double a = ray.head<2>().squaredNorm(), b = ray.x() * x + ray.y() * y;
    const double root = b * b - a * (x * x + y * y - radius * radius);
    return root > 0 && b > 0 ? (b - std::sqrt(root)) / a : kNothing;
  };
}

struct Turn {
  double noise = 0.0;  ///< [m] of the range
  bool clockwise = true;
  double start = 0.3;  ///< [deg] azimuth of the first firing
  int columns = 1800;
};
constexpr int kBeams = 16;
constexpr double kPeriod = 0.1;  ///< [s] of a turn

/// Points in firing order, beams from -15 to 15 degrees, with rings and times.
inline PointCloud scan(const Surfaces& surfaces, const Turn& turn) {
  std::mt19937 rng(17);
  std::normal_distribution<double> noise(0.0, 1.0);
  PointCloud cloud;
  for (int shot = 0; shot < turn.columns * kBeams; ++shot) {
    const int column = shot / kBeams, ring = shot % kBeams;
    const double turned = 360.0 * column / turn.columns;
    const double azimuth = (turn.start + (turn.clockwise ? -turned : turned)) * kDegree;
    const double elevation = (-15.0 + 2.0 * ring) * kDegree;
    const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
    double range = kNothing;
    for (const Surface& surface : surfaces) range = std::min(range, surface(ray));
    if (range > 100.0) continue;
    cloud.points.push_back((range + turn.noise * noise(rng)) * ray);
    cloud.rings.push_back(std::uint16_t(ring));
    cloud.times.push_back(float(kPeriod * column / turn.columns));
  }
  return cloud;
}

}  // namespace tilth::cast
