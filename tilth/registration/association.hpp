// Which source point is matched with what of the target: the pre-check comes first, the costly term only for valid
// pairs.
#pragma once

#include <concepts>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/registration/residual.hpp>

namespace tilth {

struct AssociationOptions {
  double max_distance = 1.0;
  double lambda = 1e-4;
};

template <class V>
void visit(AssociationOptions& o, V&& v) {
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a point and its match");
  v("lambda", o.lambda, Bounds{1e-12, 1}, "[m^2] added to the diagonal of every covariance");
}

/// A look-up of the target: the surface for a point, its normal, and whether it is flat; or nullptr. A surface's
/// variance is that of its covariance along its normal.
template <class L>
concept SurfaceLookup = requires(const L& lookup, const Eigen::Vector3d& p) {
  { lookup(p, p, true)->mean } -> std::convertible_to<Eigen::Vector3d>;
  { lookup(p, p, true)->normal } -> std::convertible_to<Eigen::Vector3d>;
  { lookup(p, p, true)->covariance } -> std::convertible_to<Eigen::Matrix3d>;
  { lookup(p, p, true)->variance } -> std::convertible_to<double>;
};

/// Calls add(patch, surface) for each source patch whose surface, at T, is within max_distance: the pre-check that
/// spares the weighted term of all others (Fu et al. 2026, section 2.2).
template <SurfaceLookup Lookup, class Add>
void for_each_match(const SurfacePatches& source, const Pose& T, const Lookup& target,
                    const AssociationOptions& options, const Add& add) {
  const double max_squared = options.max_distance * options.max_distance;
  for (const SurfacePatch& patch : source) {
    const Eigen::Vector3d point = T * patch.mean;
    const auto* surface = target(point, T.linear() * patch.normal, patch.flat);
    if (surface != nullptr && (surface->mean - point).squaredNorm() <= max_squared) add(patch, *surface);
  }
}

/// GICP pairs at T. The information matrices are made with the rotation of T (Fu et al. 2026, section 2.2).
template <SurfaceLookup Lookup>
std::vector<DistributionToDistribution> associate_distributions(const SurfacePatches& source, const Pose& T,
                                                                const Lookup& target,
                                                                const AssociationOptions& options) {
  std::vector<DistributionToDistribution> pairs;
  pairs.reserve(source.size());
  const Eigen::Matrix3d R = T.linear();
  for_each_match(source, T, target, options, [&](const SurfacePatch& patch, const auto& surface) {
    Eigen::Matrix3d joint = R * patch.covariance * R.transpose() + surface.covariance;
    joint.diagonal().array() += 2 * options.lambda;  // lambda I in either covariance
    pairs.push_back({patch.mean, surface.mean, whitening_of(joint)});
  });
  return pairs;
}

/// Point-to-point pairs at T: each patch's mean and that of its surface.
template <SurfaceLookup Lookup>
std::vector<PointToPoint> associate_points(const SurfacePatches& source, const Pose& T, const Lookup& target,
                                           const AssociationOptions& options) {
  std::vector<PointToPoint> pairs;
  pairs.reserve(source.size());
  for_each_match(source, T, target, options, [&](const SurfacePatch& patch, const auto& surface) {
    pairs.push_back({patch.mean, surface.mean});
  });
  return pairs;
}

}  // namespace tilth
