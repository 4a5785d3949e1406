// How a spinning sensor is mounted in the frame of its clouds, found again in the points: its axis from pieces of its
// rings, then its beams from their elevations about that axis, and the axis once more from whole rings. Some tenths of
// a second, once a recording.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <tilth/sensor/point_fields.hpp>
#include <tilth/sensor/sensor_axis.hpp>

namespace tilth {

struct SensorMount {
  Eigen::Isometry3d T_cloud_sensor = Eigen::Isometry3d::Identity();  ///< the sensor spins about its z axis
  std::vector<double> beams;                                         ///< [rad] ascending elevations in its frame
};

/// From clouds without rings, or nothing where their points lie on no beams about any axis.
std::optional<SensorMount> find_mount(std::span<const MeasuredPoints> scans);

/// From clouds whose `ring_values` name the beams, or nothing where these are no rings about any axis.
std::optional<Eigen::Isometry3d> find_mount_of_rings(std::span<const MeasuredPoints> scans);

/// `points` seen from the frame of the sensor.
std::vector<Eigen::Vector3d> in_sensor_frame(std::span<const Eigen::Vector3d> points,
                                             const Eigen::Isometry3d& T_cloud_sensor);

}  // namespace tilth
