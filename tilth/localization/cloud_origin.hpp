// Where the frame of a map of a bare cloud begins: surveys have coordinates of millions of metres, maps none.
#pragma once

#include <span>

#include <Eigen/Core>

namespace tilth {

/// Zero where the middle of `points` lies within 10 km of the origin along x and y; else that middle in whole
/// kilometres, 0 along z. Points that are not finite are passed over.
Eigen::Vector3d cloud_origin(std::span<const Eigen::Vector3d> points);

}  // namespace tilth
