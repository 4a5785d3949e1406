// One revolution of a spinning LiDAR.
#pragma once

#include <tilth/core/point_cloud.hpp>

namespace tilth {

struct Scan {
  double stamp = 0.0;  ///< [s] of the FIRST point; `cloud.times` count from here
  PointCloud cloud;    ///< in the LiDAR frame; each point as seen from the sensor's pose at its own time
};

}  // namespace tilth
