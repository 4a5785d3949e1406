// The centroid voxel grid of the LOAM family (as pcl::VoxelGrid): one point a cell, the mean of all in it.
#pragma once

#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// One point for each cell of side `size` [m] > 0 that holds any, cells counted from the origin: the mean of its points
/// and of each of their attributes (rings rounded to the nearest). Cells come in the order of their first points. O(n).
PointCloud voxel_downsample(const PointCloud& cloud, double size);

}  // namespace tilth
