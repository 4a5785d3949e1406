// The map of Gaussians against sums done by hand.
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <tilth/map/gaussian_map.hpp>

namespace tilth {
namespace {

std::vector<Eigen::Vector3d> patch(const Eigen::Vector3d& center, const Eigen::Vector3d& half, std::size_t n) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Eigen::Vector3d> points(n);
  for (Eigen::Vector3d& p : points) p = center + half.cwiseProduct(Eigen::Vector3d(u(rng), u(rng), u(rng)));
  return points;
}

TEST(GaussianMap, GathersMeanAndCovarianceOfItsPoints) {
  GaussianMap map({.voxel_size = 1.0, .regularization = Regularization::none});
  const auto points = patch({0.5, -3.5, 7.5}, {0.4, 0.3, 0.2}, 100);
  for (const Eigen::Vector3d& p : points) map.insert({&p, 1});
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / 100;
  const GaussianVoxel* voxel = map.find(points[0]);
  ASSERT_NE(voxel, nullptr);
  EXPECT_LT((voxel->mean - mean).norm(), 1e-12);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
  EXPECT_LT((voxel->scatter - scatter).norm(), 1e-9);
  EXPECT_LT((voxel->covariance - scatter / 99).norm(),
            0.15 * (scatter / 99).norm());  // up to a tenth of its points old
}

TEST(GaussianMap, AVoxelNeedsEnoughPointsAndTakesNoMoreThanItsBound) {
  GaussianMap map({.voxel_size = 1.0, .min_points = 6, .max_points = 20});
  const auto points = patch({0.5, 0.5, 0.5}, {0.4, 0.4, 0.4}, 50);
  map.insert(std::span(points).first(5));
  EXPECT_EQ(map.find(points[0]), nullptr);
  map.insert(std::span(points).subspan(5, 1));
  ASSERT_NE(map.find(points[0]), nullptr);
  map.insert(points);
  EXPECT_EQ(map.find(points[0])->count, 20u);
}

TEST(GaussianMap, SurfacesConstrainAlongTheirNormalOnly) {
  GaussianMap map({.voxel_size = 1.0, .regularization = Regularization::surface, .surface_variance = 1e-4});
  map.insert(patch({0.5, 0.5, 0.5}, {0.45, 0.45, 0.001}, 200));
  map.insert(patch({5.5, 0.5, 0.5}, {0.45, 0.001, 0.001}, 200));
  const Eigen::Matrix3d wall = map.find({0.5, 0.5, 0.5})->covariance, line = map.find({5.5, 0.5, 0.5})->covariance;
  EXPECT_NEAR(wall(2, 2), 1e-4, 2e-4);
  EXPECT_GT(wall(0, 0), 0.5);
  EXPECT_GE(line(1, 1), map.options().blur);  // a single ring says nothing across itself
}

TEST(GaussianMap, NearestLooksIntoTheNextVoxel) {
  GaussianMap map({.voxel_size = 1.0});
  map.insert(patch({0.5, 0.5, 0.5}, {0.1, 0.1, 0.1}, 20));
  EXPECT_EQ(map.find({1.1, 0.5, 0.5}), nullptr);
  ASSERT_NE(map.find_nearest({1.1, 0.5, 0.5}), nullptr);
  EXPECT_EQ(map.find_nearest({1.6, 0.5, 0.5}), nullptr);
  EXPECT_EQ(map.find({-1e30, 0, 0}), nullptr);
  EXPECT_EQ(map.find({std::nan(""), 0, 0}), nullptr);
}

TEST(GaussianMap, ForgetsWhatIsFarAndKeepsWhatIsNear) {
  GaussianMap map({.voxel_size = 1.0, .max_range = 30});
  for (int x = 0; x < 200; ++x) {
    map.insert(patch({x + 0.5, 0.5, 0.5}, {0.3, 0.3, 0.3}, 10));
    map.crop({double(x), 0, 0});
    EXPECT_LE(map.voxels().size(), 35u);
  }
  EXPECT_EQ(map.find({0.5, 0.5, 0.5}), nullptr);
  for (int x = 175; x < 200; ++x) EXPECT_NE(map.find({x + 0.5, 0.5, 0.5}), nullptr) << x;
}

}  // namespace
}  // namespace tilth
