// One revolution of a spinning LiDAR.
#pragma once

#include <optional>

#include <tilth/core/point_cloud.hpp>

namespace tilth {

struct Scan {
  double stamp = 0.0;  ///< [s] of the FIRST point; `cloud.times` count from here
  PointCloud cloud;    ///< in the LiDAR frame; each point as seen from the sensor's pose at its own time
  /// What spins, about its z axis, in the frame of the cloud; none: that is the sensor's own
  std::optional<Eigen::Isometry3d> T_cloud_sensor = {};
};

}  // namespace tilth
