// Outlier removal for clouds whose rings are not known: a point stays where it has company. O(n), no neighbour search.
#pragma once

#include <cstdint>
#include <vector>

#include <tilth/core/point_cloud.hpp>
#include <tilth/preprocess/ring_support.hpp>

namespace tilth {

/// For each point of `cloud` 1 where at least two others share its cell, in one of two grids that are half a cell
/// apart, else 0. Cells grow with the range.
std::vector<std::uint8_t> cell_support(const PointCloud& cloud);

/// The same by ring_support() where the cloud has rings; all points where these give no order to go along.
std::vector<std::uint8_t> supported(const PointCloud& cloud, const RingLayout& rings,
                                    const RingSupportOptions& options);

}  // namespace tilth
