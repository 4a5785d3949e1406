// Plain GICP on clouds: covariances by their formula, and a motion found.
#include <random>

#include <gtest/gtest.h>

#include <tilth/registration/align.hpp>
#include <tilth/registration/neighborhood_gaussians.hpp>

namespace tilth {
namespace {

// Points on the six walls of a room of 8 x 6 x 3 m.
std::vector<Eigen::Vector3d> room(std::size_t n, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Eigen::Vector3d> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = {u(rng), u(rng), u(rng)};
    points[i][long(i % 3)] = i % 6 < 3 ? -1 : 1;
    points[i] = points[i].cwiseProduct(Eigen::Vector3d(4, 3, 1.5));
  }
  return points;
}

TEST(NeighborhoodGaussians, AreSampleCovariancesOfTheNeighboursWithoutThePoint) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {9, 9, 9}};
  const SearchableCloud cloud(points);
  NeighborhoodGaussians gaussians(cloud, 3, 1e-6);
  const Eigen::Vector3d mean = (points[1] + points[2] + points[3]) / 3;
  Eigen::Matrix3d expected = 1e-6 * Eigen::Matrix3d::Identity();
  for (const std::size_t i : {1, 2, 3}) expected += (points[i] - mean) * (points[i] - mean).transpose() / 2;
  EXPECT_TRUE(gaussians.covariance(0).isApprox(expected, 1e-12));
  EXPECT_EQ(&gaussians.covariance(0), &gaussians.covariance(0));
  NeighborhoodGaussians more(cloud, 20, 1e-6);  // than there are
  EXPECT_TRUE(more.covariance(4).allFinite());
  const SearchableCloud lone({{1, 2, 3}});
  EXPECT_TRUE(NeighborhoodGaussians(lone, 3, 1e-6).covariance(0).isApprox(1e-6 * Eigen::Matrix3d::Identity()));
}

TEST(NeighborhoodGaussians, PairsLieWithinReachAndCarryTheInverseOfTheJointCovariance) {
  const std::vector<Eigen::Vector3d> points = room(600, 1);
  const SearchableCloud cloud(points);
  NeighborhoodGaussians target(cloud, 10, 1e-6);
  const GaussianPoints source = gaussians_among(room(100, 2), 10, 1e-6);
  const Pose T = exp((Vector6d() << 0.1, 0.2, -0.3, 0.2, 0, 0.1).finished());
  const auto pairs = associate_gaussians(source, T, target, 0.3);
  ASSERT_GT(pairs.size(), 10u);
  ASSERT_LT(pairs.size(), 100u);
  for (const DistributionToDistribution& pair : pairs) EXPECT_LE((T * pair.source - pair.target).norm(), 0.3);
  const auto nearest = cloud.nearest(T * pairs[0].source);
  std::size_t i = 0;
  while (source.means[i] != pairs[0].source) ++i;
  const Eigen::Matrix3d joint =
      T.linear() * source.covariances[i] * T.linear().transpose() + target.covariance(nearest->index);
  EXPECT_TRUE((pairs[0].information * joint).isApprox(Eigen::Matrix3d::Identity(), 1e-6));
  EXPECT_TRUE(associate_gaussians({}, T, target, 0.3).empty());
}

TEST(NeighborhoodGaussians, FindAMotionInARoom) {
  const SearchableCloud cloud(room(6000, 1));
  NeighborhoodGaussians target(cloud, 10, 1e-6);
  const Pose truth = exp((Vector6d() << 0.01, -0.02, 0.05, 0.1, -0.05, 0.04).finished());
  std::vector<Eigen::Vector3d> seen;
  for (const Eigen::Vector3d& p : room(3000, 2)) seen.push_back(truth.inverse() * p);
  const GaussianPoints source = gaussians_among(seen, 10, 1e-6);
  const AlignResult found = align(Pose::Identity(), AlignOptions(),
                                  [&](const Pose& T) { return associate_gaussians(source, T, target, 1.0); });
  EXPECT_TRUE(found.converged);
  EXPECT_LT(log(truth.inverse() * found.T_target_source).norm(), 5e-3);
}

}  // namespace
}  // namespace tilth
