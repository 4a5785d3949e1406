// Keyframes of a drive through a room of flat walls, as a sensor with flawed beams measures them, without the
// simulator.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <tilth/calibration/beam_estimator.hpp>

namespace tilth {

inline constexpr std::size_t kDriveBeams = 16;

struct FlawedDrive {
  BeamModel beams;     // that the sensor has
  double noise = 0.0;  // [m] of a range
  std::uint32_t seed = 1;
};

/// [m] from inside a room of 14.3 x 9.1 x 3.2 m along `direction` to a wall; its floor is at z = 0.
inline double range_to_wall(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d low(-4.13, -4.47, 0), high(10.17, 4.63, 3.2);
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const double wall = direction[axis] > 0 ? high[axis] : low[axis];
    nearest = std::min(nearest, (wall - origin[axis]) / direction[axis]);
  }
  return nearest;
}

/// A scan, taken at once.
inline BeamKeyframe flawed_keyframe(const FlawedDrive& drive, const Pose& T_map_lidar, std::mt19937& random) {
  std::normal_distribution<double> noise(0, 1);
  BeamKeyframe keyframe;
  keyframe.T_map_lidar = T_map_lidar;
  for (int column = 0; column < 360; ++column) {
    for (std::size_t ring = 0; ring < kDriveBeams; ++ring) {
      const double azimuth = (column + 0.3) * std::numbers::pi / 180;
      const double elevation = (-15 + 2 * double(ring)) * std::numbers::pi / 180;
      const Eigen::Vector3d nominal(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                    std::sin(elevation));
      const Eigen::Vector3d direction = T_map_lidar.linear() * true_direction(drive.beams, ring, nominal);
      const float intensity = column % 7 < 3 ? 40.0F : 200.0F;
      const double range = range_to_wall(T_map_lidar.translation(), direction);
      const double seen = reported_range(drive.beams, ring, range, intensity) + drive.noise * noise(random);
      keyframe.returns.push_back({(seen * nominal).cast<float>(), 0.0F, intensity, std::uint16_t(ring)});
    }
  }
  return keyframe;
}

/// Windows of six keyframes along a winding way; poses are the true ones.
inline KeyframeWindows windows_of(const FlawedDrive& drive, std::size_t windows) {
  std::mt19937 random(drive.seed);
  KeyframeWindows result(windows);
  for (std::size_t i = 0; i < 6 * windows; ++i) {
    const double t = double(i) * 0.37;
    const Eigen::Vector3d place(3 + 4 * std::sin(0.31 * t), 2.5 * std::sin(0.53 * t + 1), 1.1 + 0.1 * std::sin(t));
    const Pose T = Eigen::Translation3d(place) * Eigen::AngleAxisd(0.9 * t, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(0.1 * std::sin(0.7 * t), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(0.1 * std::sin(1.1 * t), Eigen::Vector3d::UnitX());
    result[i / 6].push_back(flawed_keyframe(drive, T, random));
  }
  return result;
}

/// One draw of what a worn sensor has.
inline BeamModel worn_beams(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  BeamModel beams;
  for (std::size_t k = 0; k < kDriveBeams; ++k) {
    beams.range.push_back(0.02 * normal(random));
    beams.elevation.push_back(0.0026 * normal(random));
  }
  beams.encoder = 0.0005 * Eigen::Vector4d(normal(random), normal(random), 0, 0);
  beams.walk = 0.02, beams.bright = 200;
  return beams;
}

inline BeamModel ideal_beams() {
  BeamModel beams;
  beams.bright = 200;
  return beams;
}

}  // namespace tilth
