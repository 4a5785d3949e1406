// When each point of a scan was measured, told from its azimuth as LOAM and LeGO-LOAM do (Zhang and Singh 2014).
#pragma once

#include <vector>

#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// [s] since the first point of `cloud`, whose last point is measured `period` [s] after it: the share of the way that
/// a head turning clockwise has gone from the azimuth of the first point to that of the last one, which is between half
/// a turn and one and a half. O(n).
std::vector<float> azimuth_times(const PointCloud& cloud, double period);

}  // namespace tilth
