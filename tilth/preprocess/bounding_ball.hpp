// The smallest ball that holds some points (Welzl 1991, by moving to the front), and the density of points by it: rho
// of Fu et al. 2026, section 2.3, as printed.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/point_cloud.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

struct BoundingBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double squared_radius = -1.0;                      ///< [m^2]; negative: it holds nothing
};

/// The smallest ball that holds all of `points` [m], to within 1e-9 of its radius, whatever hull they span; their order
/// changes nothing but the last bits. O(points) as a rule.
BoundingBall bounding_ball(std::vector<Eigen::Vector3d> points);

/// rho_i = k / volume of the smallest ball that holds the k neighbours of point i (not the point itself), lengths
/// multiplied by scale_i; the radius counts as a micrometre at least. `scale` is empty (all 1) or has one a point, as
/// has `rho`.
void bounding_ball_densities(const PointCloud& cloud, const NeighborTable& neighbors, std::span<const float> scale,
                             std::span<float> rho);

}  // namespace tilth
