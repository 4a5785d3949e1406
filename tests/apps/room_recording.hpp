// A recording made for tests: a sensor of 16 beams that moves 5 cm a scan through a box of a room, without noise but
// for a few millimetres that repeat exactly.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>

#include <tilth/core/point_cloud.hpp>
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/pcd.hpp>

namespace tilth::app {

constexpr double kStep = 0.05;  // [m] from scan to scan, along x
constexpr int kBeams = 16, kColumns = 600;

/// [m] along `direction` from `origin` to the walls of the room.
inline double range_in_room(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d low(-6, -4, -1.2), high(7, 5, 1.8);
  double range = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double wall = direction[axis] > 0 ? high[axis] : low[axis];
    range = std::min(range, (wall - origin[axis]) / direction[axis]);
  }
  return range;
}

inline PointCloud room_scan(int index) {
  PointCloud cloud;
  const Eigen::Vector3d origin(kStep * index, 0, 0);
  for (int beam = 0; beam < kBeams; ++beam) {
    const double elevation = (-15.0 + 2.0 * beam) * std::numbers::pi / 180;
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = -2 * std::numbers::pi * column / kColumns;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const double error = 0.003 * std::sin(12.9898 * column + 78.233 * beam + 37.719 * index);
      cloud.points.push_back((range_in_room(origin, direction) + error) * direction);
      cloud.intensities.push_back(float(beam));
      cloud.rings.push_back(std::uint16_t(beam));
    }
  }
  return cloud;
}

inline std::string scan_name(int index) {
  return "scan" + std::to_string(index) + ".pcd";
}

inline void write_scan(const std::filesystem::path& folder, int index, const PointCloud& cloud) {
  write_pcd(folder / scan_name(index), to_records(cloud));
}

/// `scans` scans of the room in `folder`, which is made.
inline void write_room(const std::filesystem::path& folder, int scans) {
  std::filesystem::create_directories(folder);
  for (int i = 0; i < scans; ++i) write_scan(folder, i, room_scan(i));
}

}  // namespace tilth::app
