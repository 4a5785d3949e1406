// The floor as one plane: the widest surface below the sensor that a robot can stand on. By random samples (Fischler
// and Bolles 1981) from a fixed seed, then by least squares on what lies in it. O(samples * points).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include <tilth/core/se3.hpp>

namespace tilth {

struct FloorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< upwards, of length 1
  double depth = 0.0;                                 ///< [m] that it lies below the sensor
  double thickness = 0.0;                             ///< [m] standard deviation of its points from it
  std::size_t points = 0;                             ///< that lie in it
};

/// The floor among `points` [m], evenly thinned, as seen from `sensor`, in a frame whose z is upwards to 45 degrees.
/// Nothing where no surface below it is wide enough in both directions, or where much lies below the widest one.
std::optional<FloorPlane> find_floor(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& sensor);

/// The rotation that makes the floor's normal z by the shortest way.
Pose levelling(const FloorPlane& floor);

/// [rad] between the floor's normal and z.
double tilt_of(const FloorPlane& floor);

}  // namespace tilth
