// Undoes the sensor's own motion within a scan, with the velocity held constant.
#pragma once

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/se3.hpp>

namespace tilth {

/// The points of `cloud` as the sensor would have seen them, all at once, at `reference_time` [s since the stamp].
/// `velocity` [rad/s, m/s] is the LiDAR's, in its own frame. Covariances are rotated along; times remain what they
/// were. A cloud without times comes back as it is. O(n).
PointCloud deskew(const PointCloud& cloud, const Vector6d& velocity, double reference_time);

}  // namespace tilth
