// How sharp a map is, without truth: the thickness of its surfaces, the mean plane variance and the mean map entropy
// (J. Razlaw, D. Droeschel, D. Holz and S. Behnke, Evaluation of registration methods for sparse 3D laser scans, ECMR
// 2015), each of the points in the cells of a grid instead of those about every point. O(n).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

struct MapQuality {
  std::size_t cells = 0, planes = 0;  ///< cells with points enough; of these, those that hold one plane
  double thickness_median = 0.0;      ///< [m] standard deviation of the points across their plane
  double thickness_p90 = 0.0;         ///< [m] 90th percentile of it
  double plane_variance = 0.0;        ///< [m^2] mean of its square
  double entropy = 0.0;               ///< [nats] mean of 0.5 ln det(2 pi e covariance) over all cells
};

/// Of points [m]; all zero where no cell has points enough. Maps of the same recording in the same voxels can be
/// compared; the figures of different places cannot.
MapQuality quality_of(std::span<const Eigen::Vector3f> points);

}  // namespace tilth
