// The points of a scan gathered in the cells of a grid, wider where they are farther away, with their moments. Points
// that were taken at different times share no cell: the sensor has moved in between. O(n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/point_cloud.hpp>
#include <tilth/features/moments.hpp>

namespace tilth {

struct PointCell {
  Moments moments;
  float time = 0.0f;  ///< [s] mean of its points; 0 where they have none
};

/// How long [s] the points of a cell of `cloud` may be apart in time; 0 where they have no times.
double cell_duration(const PointCloud& cloud);

/// The cells in the order of their first points. Edges [m] are `length`, and as many times twice that as keep a beam's
/// neighbouring points in one cell. Points whose entry in `keep`, one a point, is zero are passed over.
std::vector<PointCell> point_cells(const PointCloud& cloud, std::span<const std::uint8_t> keep, double length);

}  // namespace tilth
