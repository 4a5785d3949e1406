// Where a spinning sensor stands in the frame of its clouds, and how its axis lies: all points of a ring are seen from
// its origin at one angle from the axis (a cone). Gauss-Newton over the five unknowns, the angle of each ring
// eliminated, rings that do not fit weighed down (Geman-McClure). O(points) a step.
#pragma once

#include <Eigen/Geometry>

#include <tilth/sensor/ring_arcs.hpp>

namespace tilth {

struct SensorAxis {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit
  double error = 0.0;                                ///< [rad] between an arc and its ring, median of all arcs

  /// Points of the sensor's frame, whose z axis is the axis, in the frame of the cloud.
  Eigen::Isometry3d T_cloud_sensor() const;
};

/// The axis that fits best from `start` on, in `steps` steps at most.
SensorAxis fit_axis(const RingArcs& arcs, const SensorAxis& start, int steps);

/// The axis that fits best, from wherever: begun with many axes and origins within some metres.
SensorAxis search_axis(const RingArcs& arcs);

}  // namespace tilth
