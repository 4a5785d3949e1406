// Points worth keeping: finite ones, within the sensor's range.
#pragma once

#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// The finite points whose distance from the sensor lies in [min_range, max_range] [m], in their order. O(n).
PointCloud crop_range(const PointCloud& cloud, double min_range, double max_range);

}  // namespace tilth
