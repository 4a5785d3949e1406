// Whether three runs lie in one plane, judged by how much the points of each scatter about it. Where a floor meets a
// wall, two lines on one and one on the other are as thin together as a noisy plane, and their normal is none of
// either's: such patches bow a map. O(1).
#pragma once

#include <tilth/features/joined_shapes.hpp>

namespace tilth {

/// [m^2] of three runs, along the normal of the plane that they make together: sums over their points.
struct PlaneMisfit {
  double within = 0;   ///< of squared distances from the plane through their run's mean
  double between = 0;  ///< of squared distances of these means from the joint plane
  double points = 0;
};

PlaneMisfit plane_misfit(const RunSet& three, const Eigen::Vector3d& normal);

/// Lines that a plane fits as well as their noise lets it: of three parallel ones a single deviation is left, which is
/// at most `max_sigma` standard deviations, and `roughness` [m] more.
bool is_one_plane(const PlaneMisfit& misfit, double max_sigma, double roughness);

}  // namespace tilth
