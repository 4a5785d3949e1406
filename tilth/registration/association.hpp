// Which source point is matched with what of the target: the pre-check comes first, the costly term only for valid pairs.
#pragma once

#include <Eigen/Eigenvalues>
#include <concepts>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/registration/residual.hpp>

namespace tilth {

struct AssociationOptions {
  double max_distance = 0.5;
  double lambda = 1e-6;
  int mode = 0; double tang = 1.0; double lin = 0.05; double srcmin = 1e-6; double nmin=1e-4; int smode=0;
};

template <class V>
void visit(AssociationOptions& o, V&& v) {
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a point and its match");
  v("lambda", o.lambda, Bounds{1e-12, 1}, "[m^2] added to the diagonal of every covariance");
  v("mode", o.mode, "[-] x"); v("tang", o.tang, "[-] x"); v("lin", o.lin, "[-] x"); v("srcmin", o.srcmin, "[-] x"); v("nmin", o.nmin, "[-] x");v("smode", o.smode, "[-] x");
}

/// A target of distributions: the nearest Gaussian to a point, with `mean` and `covariance()`, or nullptr.
template <class M>
concept NearestGaussian = requires(const M& map, const Eigen::Vector3d& p) {
  { map.find_nearest(p)->mean } -> std::convertible_to<Eigen::Vector3d>;
  { map.find_nearest(p)->covariance() } -> std::convertible_to<Eigen::Matrix3d>;
};

/// GICP pairs at T: each source point (with covariance) and the nearest Gaussian within max_distance. The information
/// matrices are made with the rotation of T (Fu et al. 2026, section 2.2).
template <NearestGaussian Map>
std::vector<DistributionToDistribution> associate_distributions(const PointCloud& source, const Pose& T, const Map& target,
                                                                const AssociationOptions& options) {
  std::vector<DistributionToDistribution> pairs;
  pairs.reserve(source.size());
  const Eigen::Matrix3d R = T.linear();
  const double max_squared = options.max_distance * options.max_distance;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d point = T * source.points[i];
    const auto* gaussian = target.find_nearest(point);
    if (gaussian == nullptr || (gaussian->mean - point).squaredNorm() > max_squared) continue;
    Eigen::Matrix3d tc = gaussian->covariance();
    if (options.mode) {
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> es; es.computeDirect(tc);
      Eigen::Vector3d ev = es.eigenvalues();
      if (options.mode & 1) { if (ev[1] < options.lin * ev[2]) continue; }
      if (options.mode & 2) { if (ev[0] > 0.1 * ev[1]) continue; }
      if (options.mode & 4) { ev = Eigen::Vector3d(std::max(ev[0], options.nmin), options.tang, options.tang); }
      if (options.mode & 16) {
        const bool planar = ev[0] < 0.1 * ev[1] && ev[1] > options.lin * ev[2];
        if (planar) ev = Eigen::Vector3d(std::max(ev[0], options.nmin), options.tang, options.tang);
        else ev.array() += options.srcmin;
      }
      if (options.mode & 8) { ev[0] = std::max(ev[0], options.nmin);ev[1]=std::max(ev[1],ev[2]*options.lin); }
      tc = es.eigenvectors() * ev.asDiagonal() * es.eigenvectors().transpose();
    }
    Eigen::Matrix3d sc = R * source.covariances[i] * R.transpose();
    if (options.smode == 1) sc = Eigen::Matrix3d::Identity() * options.srcmin;
    Eigen::Matrix3d joint = sc + tc;
    joint.diagonal().array() += 2 * options.lambda;  // lambda I in either covariance
    pairs.push_back({source.points[i], gaussian->mean, whitening_of(joint)});
  }
  return pairs;
}

/// Point-to-point pairs at T: each source point and the nearest target mean within max_distance.
template <NearestGaussian Map>
std::vector<PointToPoint> associate_points(const PointCloud& source, const Pose& T, const Map& target, const AssociationOptions& options) {
  std::vector<PointToPoint> pairs;
  pairs.reserve(source.size());
  const double max_squared = options.max_distance * options.max_distance;
  for (const Eigen::Vector3d& p : source.points) {
    const Eigen::Vector3d point = T * p;
    const auto* gaussian = target.find_nearest(point);
    if (gaussian == nullptr || (gaussian->mean - point).squaredNorm() > max_squared) continue;
    pairs.push_back({p, gaussian->mean});
  }
  return pairs;
}

}  // namespace tilth
