// GICP as it was published (Segal et al. 2009; Fu et al. 2026, section 2.2): points, each with the sample covariance of
// its k nearest neighbours, held against points that have theirs.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <tilth/registration/residual.hpp>
#include <tilth/search/searchable_cloud.hpp>

namespace tilth {

/// Points [m] with a covariance [m^2] each.
struct GaussianPoints {
  std::vector<Eigen::Vector3d> means;
  std::vector<Eigen::Matrix3d> covariances;
};

/// The covariances of a cloud's points: 1/(m - 1) sum (q - mean)(q - mean)^T + lambda I over the m nearest other points
/// of the cloud, at most k. Each is made when it is asked for, and kept. The cloud must outlive this.
class NeighborhoodGaussians {
 public:
  NeighborhoodGaussians(const SearchableCloud& cloud, int k, double lambda)
      : cloud_(cloud), k_(std::size_t(k)), lambda_(lambda), covariances_(cloud.size()) {}

  const SearchableCloud& cloud() const { return cloud_; }

  /// Of point i; O(log n + k) the first time.
  const Eigen::Matrix3d& covariance(std::size_t i);

 private:
  const SearchableCloud& cloud_;
  std::size_t k_;
  double lambda_;
  std::vector<std::optional<Eigen::Matrix3d>> covariances_;
  std::vector<Neighbor> neighbors_;
};

/// `means` with the covariances of their neighbours among themselves.
GaussianPoints gaussians_among(const std::vector<Eigen::Vector3d>& means, int k, double lambda);

/// The pair of each source point that has a point of the target within `max_distance` [m] of it at T, with the nearest
/// one; their information is that of R = T's rotation.
std::vector<DistributionToDistribution> associate_gaussians(const GaussianPoints& source, const Pose& T,
                                                            NeighborhoodGaussians& target, double max_distance);

/// The same without covariances, for ICP (Besl and McKay 1992).
std::vector<PointToPoint> associate_nearest(const GaussianPoints& source, const Pose& T, const SearchableCloud& target,
                                            double max_distance);

}  // namespace tilth
