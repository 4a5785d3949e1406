// Which source point is matched with what of the target: the pre-check comes first, the costly term only for valid
// pairs.
#pragma once

#include <concepts>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/registration/residual.hpp>

namespace tilth {

struct AssociationOptions {
  double max_distance = 1.0;
  double lambda = 2e-3;
};

template <class V>
void visit(AssociationOptions& o, V&& v) {
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a point and its match");
  v("lambda", o.lambda, Bounds{1e-12, 1}, "[m^2] added to the diagonal of every covariance");
}

/// A look-up of the target: a point's Gaussian, with `mean` and `covariance`, or nullptr.
template <class L>
concept GaussianLookup = requires(const L& lookup, const Eigen::Vector3d& p) {
  { lookup(p)->mean } -> std::convertible_to<Eigen::Vector3d>;
  { lookup(p)->covariance } -> std::convertible_to<Eigen::Matrix3d>;
};

/// GICP pairs at T: each source point (with covariance) and its Gaussian, if that is within max_distance. The
/// information matrices are made with the rotation of T (Fu et al. 2026, section 2.2).
template <GaussianLookup Lookup>
std::vector<DistributionToDistribution> associate_distributions(const PointCloud& source, const Pose& T,
                                                                const Lookup& target,
                                                                const AssociationOptions& options) {
  std::vector<DistributionToDistribution> pairs;
  pairs.reserve(source.size());
  const Eigen::Matrix3d R = T.linear();
  const double max_squared = options.max_distance * options.max_distance;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d point = T * source.points[i];
    const auto* gaussian = target(point);
    if (gaussian == nullptr || (gaussian->mean - point).squaredNorm() > max_squared) continue;
    Eigen::Matrix3d joint = R * source.covariances[i] * R.transpose() + gaussian->covariance;
    joint.diagonal().array() += 2 * options.lambda;  // lambda I in either covariance
    pairs.push_back({source.points[i], gaussian->mean, whitening_of(joint)});
  }
  return pairs;
}

/// Point-to-point pairs at T: each source point and the mean of its Gaussian, if that is within max_distance.
template <GaussianLookup Lookup>
std::vector<PointToPoint> associate_points(const PointCloud& source, const Pose& T, const Lookup& target,
                                           const AssociationOptions& options) {
  std::vector<PointToPoint> pairs;
  pairs.reserve(source.size());
  const double max_squared = options.max_distance * options.max_distance;
  for (const Eigen::Vector3d& p : source.points) {
    const Eigen::Vector3d point = T * p;
    const auto* gaussian = target(point);
    if (gaussian == nullptr || (gaussian->mean - point).squaredNorm() > max_squared) continue;
    pairs.push_back({p, gaussian->mean});
  }
  return pairs;
}

}  // namespace tilth
