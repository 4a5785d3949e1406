// Times of points from their azimuth alone, for a scan of a spinning sensor whose points are too few, or stored in
// another order than that of firing, to follow the head.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

/// A head that stands at `cut` [rad] when a scan begins.
struct TurningHead {
  double cut = 0.0;
  double period = 0.1;    ///< [s] of one turn
  bool clockwise = true;  ///< seen from +z
};

/// [s] since the scan began, at most a period, one a point. O(n).
std::vector<double> times_by_azimuth(std::span<const Eigen::Vector3d> points, const TurningHead& head);

}  // namespace tilth
