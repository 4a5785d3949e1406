#include <algorithm>

#include <tilth/registration/neighborhood_gaussians.hpp>

namespace tilth {

const Eigen::Matrix3d& NeighborhoodGaussians::covariance(std::size_t i) {
  std::optional<Eigen::Matrix3d>& covariance = covariances_[i];
  if (covariance) return *covariance;
  const std::span<const Eigen::Vector3d> points = cloud_.points();
  cloud_.knn(points[i], k_ + 1, neighbors_);
  std::erase_if(neighbors_, [i](const Neighbor& n) { return n.index == i; });
  neighbors_.resize(std::min(neighbors_.size(), k_));  // the point itself was not found where more than k lie on it
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Neighbor& n : neighbors_) mean += points[n.index] / double(neighbors_.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Neighbor& n : neighbors_) scatter += (points[n.index] - mean) * (points[n.index] - mean).transpose();
  const double freedom = std::max(1.0, double(neighbors_.size()) - 1);
  covariance = scatter / freedom + lambda_ * Eigen::Matrix3d::Identity();
  return *covariance;
}

GaussianPoints gaussians_among(const std::vector<Eigen::Vector3d>& means, int k, double lambda) {
  GaussianPoints gaussians{means, {}};
  const SearchableCloud cloud(means);
  NeighborhoodGaussians neighborhoods(cloud, k, lambda);
  gaussians.covariances.reserve(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) gaussians.covariances.push_back(neighborhoods.covariance(i));
  return gaussians;
}

std::vector<DistributionToDistribution> associate_gaussians(const GaussianPoints& source, const Pose& T,
                                                            NeighborhoodGaussians& target, double max_distance) {
  std::vector<DistributionToDistribution> pairs;
  pairs.reserve(source.means.size());
  const Eigen::Matrix3d R = T.linear();
  for (std::size_t i = 0; i < source.means.size(); ++i) {
    const std::optional<Neighbor> nearest = target.cloud().nearest(T * source.means[i]);
    if (!nearest || nearest->squared_distance > max_distance * max_distance) continue;
    const Eigen::Matrix3d joint = R * source.covariances[i] * R.transpose() + target.covariance(nearest->index);
    pairs.push_back({source.means[i], target.cloud().points()[nearest->index], inverse_of(joint)});
  }
  return pairs;
}

std::vector<PointToPoint> associate_nearest(const GaussianPoints& source, const Pose& T, const SearchableCloud& target,
                                            double max_distance) {
  std::vector<PointToPoint> pairs;
  pairs.reserve(source.means.size());
  for (const Eigen::Vector3d& p : source.means) {
    const std::optional<Neighbor> nearest = target.nearest(T * p);
    if (nearest && nearest->squared_distance <= max_distance * max_distance)
      pairs.push_back({p, target.points()[nearest->index]});
  }
  return pairs;
}

}  // namespace tilth
