// A result as Python keeps it.
#pragma once

#include <optional>

#include <tilth/odometry/odometry.hpp>

namespace tilth::python {

struct ScanResult {
  OdometryResult result;
  double scan_stamp = 0.0;  ///< [s] of the scan's first point

  /// The filtered scan as the sensor would have seen it all at once at result.stamp.
  PointCloud deskewed() const;
};

}  // namespace tilth::python
