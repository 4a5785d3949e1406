// The motion within a scan undone.
#pragma once

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan_tremor.hpp>
#include <tilth/core/surface_patch.hpp>

namespace tilth {

/// `patches` as the sensor would have seen them, all at once, at `reference_time` [s since the stamp]. `velocity`
/// [rad/s, m/s] is the LiDAR's, in its own frame; `tremor` is what it does beside that. Times remain what they were.
/// O(n).
SurfacePatches deskew(SurfacePatches patches, const Vector6d& velocity, double reference_time,
                      const ScanTremor& tremor = {});

/// The points of a scan likewise; a cloud without times stays as it is.
PointCloud deskew(PointCloud cloud, const Vector6d& velocity, double reference_time);

}  // namespace tilth
