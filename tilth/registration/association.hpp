// Which source point is matched with what of the target: the pre-check comes first, the costly term only for valid
// pairs.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/core/symmetric3.hpp>
#include <tilth/registration/residual.hpp>

namespace tilth {

struct AssociationOptions {
  double max_distance = 1.0;
  double lambda = 1e-4;
  double renew_distance = 0.02;
};

template <class V>
void visit(AssociationOptions& o, V&& v) {
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a point and its match");
  v("lambda", o.lambda, Bounds{1e-12, 1}, "[m^2] added to the diagonal of every covariance", kAdvanced);
  v("renew_distance", o.renew_distance, Bounds{0, 10}, "[m] that a patch moves before its match is looked up anew",
    kAdvanced);
}

/// What patches are registered to: find() gives the surface for a point, its normal, and whether it is flat; or
/// nullptr. A surface's variance is that of its covariance along its normal. Surfaces stay where they are as long as
/// they are matched.
template <class M>
concept SurfaceMap = requires(const M& map, const Eigen::Vector3d& p) {
  { map.find(p, p, true)->mean } -> std::convertible_to<Eigen::Vector3d>;
  { map.find(p, p, true)->normal } -> std::convertible_to<Eigen::Vector3d>;
  { map.find(p, p, true)->covariance } -> std::convertible_to<Eigen::Matrix3d>;
  { map.find(p, p, true)->variance } -> std::convertible_to<double>;
};

template <SurfaceMap M>
using SurfaceOf = std::remove_cvref_t<decltype(*std::declval<const M&>().find({}, {}, true))>;

/// What a patch was matched with, and where it then was: looked up anew once it has moved.
template <class Surface>
struct SurfaceMatch {
  const Surface* surface = nullptr;
  Eigen::Vector3d point_in_target = Eigen::Vector3d::Constant(1e300);
};

/// The surface of a patch that now lies at `point`: of `match`, unless it has moved farther than the root of
/// `renew_squared`; then look_up() gives the new one.
template <class Surface, class LookUp>
const Surface* surface_at(const Eigen::Vector3d& point, double renew_squared, SurfaceMatch<Surface>& match,
                          const LookUp& look_up) {
  if ((point - match.point_in_target).squaredNorm() > renew_squared) match = {look_up(), point};
  return match.surface;
}

/// Patches, and what they were matched with in the iteration before: nothing at first.
template <class Surface>
struct MatchedPatches {
  SurfacePatches patches;
  std::vector<SurfaceMatch<Surface>> matches = {};  ///< one a patch, or none
};

/// Calls add(patch, surface) for each source patch whose surface, at T, is within max_distance: the pre-check that
/// spares the weighted term of all others (Fu et al. 2026, section 2.2).
template <SurfaceMap Map, class Add>
void for_each_match(MatchedPatches<SurfaceOf<Map>>& source, const Pose& T, const Map& map,
                    const AssociationOptions& options, const Add& add) {
  auto& [patches, matches] = source;
  const double max_squared = options.max_distance * options.max_distance;
  const double renew_squared = options.renew_distance * options.renew_distance;
  matches.resize(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SurfacePatch& patch = patches[i];
    const Eigen::Vector3d point = T * patch.mean;
    const auto look_up = [&] { return map.find(point, T.linear() * patch.normal, patch.flat); };
    const SurfaceOf<Map>* surface = surface_at(point, renew_squared, matches[i], look_up);
    if (surface != nullptr && (surface->mean - point).squaredNorm() <= max_squared) add(patch, *surface);
  }
}

/// GICP pairs at T. The information matrices are made with the rotation of T (Fu et al. 2026, section 2.2).
template <SurfaceMap Map>
std::vector<DistributionToDistribution> associate_distributions(MatchedPatches<SurfaceOf<Map>>& source, const Pose& T,
                                                                const Map& map, const AssociationOptions& options) {
  std::vector<DistributionToDistribution> pairs;
  pairs.reserve(source.patches.size());
  const Eigen::Matrix3d R = T.linear();
  for_each_match(source, T, map, options, [&](const SurfacePatch& patch, const auto& surface) {
    Eigen::Matrix3d joint = rotated(R, patch.covariance).matrix() + surface.covariance;
    joint.diagonal().array() += 2 * options.lambda;  // lambda I in either covariance
    pairs.push_back({patch.mean, surface.mean, inverse_of(joint)});
  });
  return pairs;
}

/// Point-to-point pairs at T: each patch's mean and that of its surface.
template <SurfaceMap Map>
std::vector<PointToPoint> associate_points(MatchedPatches<SurfaceOf<Map>>& source, const Pose& T, const Map& map,
                                           const AssociationOptions& options) {
  std::vector<PointToPoint> pairs;
  pairs.reserve(source.patches.size());
  for_each_match(source, T, map, options, [&](const SurfacePatch& patch, const auto& surface) {
    pairs.push_back({patch.mean, surface.mean});
  });
  return pairs;
}

}  // namespace tilth
