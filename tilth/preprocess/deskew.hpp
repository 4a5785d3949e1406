// The motion within a scan undone.
#pragma once

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/core/surface_patch.hpp>

namespace tilth {

/// `patches` as the sensor would have seen them, all at once, at `reference_time` [s since the stamp], about which
/// it moves as told. Times remain what they were. O(n).
SurfacePatches deskew(SurfacePatches patches, const MotionInScan& motion, double reference_time);

/// The points of a scan likewise; a cloud without times stays as it is.
PointCloud deskew(PointCloud cloud, const MotionInScan& motion, double reference_time);

}  // namespace tilth
