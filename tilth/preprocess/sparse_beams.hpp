// A dense sensor as one with fewer beams: what neighbouring beams say of a surface's normal is drowned by their noise
// where they lie closer together than that, and patches of dense and sparse sensors are not alike.
#pragma once

#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// The points of beams that are at least `spacing` [deg] of elevation apart, by ring, their rings numbered anew
/// from 0. A beam's elevation is the median of its points'. A cloud without rings, or whose beams are that far
/// apart already, stays as it is. O(n).
PointCloud sparse_beams(PointCloud cloud, double spacing);

}  // namespace tilth
