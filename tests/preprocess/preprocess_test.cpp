// Crop, deskew and the outlier filter; the filter against its formulas written out plainly.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/preprocess/neighbor_distances.hpp>
#include <tilth/preprocess/outlier_removal.hpp>

namespace tilth {
namespace {

TEST(Crop, DropsNearFarAndNonFinitePoints) {
  PointCloud cloud;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  cloud.points = {{1, 0, 0}, {0.1, 0, 0}, {nan, 0, 0}, {0, inf, 0}, {50, 0, 0}, {0, 3, 4}};
  cloud.rings = {0, 1, 2, 3, 4, 5};
  const PointCloud cropped = crop_range(cloud, 0.5, 5.0);
  EXPECT_EQ(cropped.rings, (std::vector<std::uint16_t>{0, 5}));
  EXPECT_TRUE(crop_range({}, 0.5, 5.0).empty());
}

TEST(Deskew, PutsAWallSeenInMotionBackInOnePlace) {
  const Vector6d velocity = (Vector6d() << 0.1, -0.2, 1.5, 2.0, 0.3, -0.1).finished();
  const Eigen::Vector3d fixed(4, 1, 0.5);  // in the LiDAR's frame at t = 0.05
  const Eigen::Matrix3d covariance = Eigen::Vector3d(4, 2, 1).asDiagonal();
  SurfacePatches patches;
  for (int i = 0; i <= 10; ++i) {
    const double t = 0.0099 * i;
    const Pose T = exp(velocity * (t - 0.05)).inverse();
    patches.push_back({.mean = T * fixed,
                       .covariance = T.linear() * covariance * T.linear().transpose(),
                       .normal = T.linear() * Eigen::Vector3d::UnitX(),
                       .time = float(t)});
  }
  for (const SurfacePatch& patch : deskew(patches, velocity, 0.05)) {
    EXPECT_LT((patch.mean - fixed).norm(), 1e-5);
    EXPECT_LT((patch.normal - Eigen::Vector3d::UnitX()).norm(), 1e-5);
    EXPECT_LT((patch.covariance - covariance).norm(), 1e-4);
  }
  for (SurfacePatch& patch : patches) patch.time = 0;  // no times
  EXPECT_EQ(deskew(patches, velocity, 0.05)[3].mean, patches[3].mean);
}

// A dense sheet with a few points far off it.
PointCloud sheet_with_outliers(std::size_t outliers) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> u(-2, 2);
  PointCloud cloud;
  for (int i = 0; i < 2000; ++i) cloud.points.push_back({5 + 0.002 * u(rng), u(rng), u(rng)});
  for (std::size_t i = 0; i < outliers; ++i) cloud.points.push_back({2.0 + u(rng) / 2, u(rng), u(rng)});
  return cloud;
}

TEST(OutlierRemoval, WeightedMeansFollowTheFormula) {
  const PointCloud cloud = sheet_with_outliers(21);
  const NeighborTable table = scan_neighbors(cloud, 10);
  const std::vector<float> scale(cloud.size(), 0.5f);
  const float decay = 3.0f;
  const std::vector<float> means = mean_distances(table, scale, decay);
  double all = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double weights = 0, sum = 0;
    for (const float squared : table.distances(i)) {
      const double d = 0.5 * std::sqrt(squared), w = std::exp(-decay * d);
      weights += w;
      sum += w * d;
      all += d / 10;
    }
    EXPECT_NEAR(means[i], sum / weights, 1e-5 * sum / weights) << i;
  }
  EXPECT_NEAR(mean_distance(table, scale), all / double(cloud.size()), 1e-5);
}

// Its weights underflow one by one; had it no finite mean, the threshold would let everything else through.
TEST(OutlierRemoval, TakesAPointHundredsOfMeanDistancesAway) {
  PointCloud cloud = sheet_with_outliers(20);
  cloud.points.push_back({5000, 0, 0});
  const NeighborTable table = scan_neighbors(cloud, 10);
  const std::vector<float> scale(cloud.size(), 1.0f);
  EXPECT_NEAR(mean_distances(table, scale, 50.0f).back(), 4995, 5);
  const auto keep = keep_inliers(cloud, table, {.method = OutlierMethod::weighted});
  EXPECT_LE(std::count(keep.begin() + 2000, keep.end(), 1), 2);
}

TEST(OutlierRemoval, RemovesWhatIsAloneAndKeepsTheSheet) {
  const PointCloud cloud = sheet_with_outliers(20);
  for (const OutlierMethod method : {OutlierMethod::plain, OutlierMethod::weighted}) {
    for (const DensityTerm density : {DensityTerm::none, DensityTerm::inverse, DensityTerm::difference}) {
      const OutlierOptions options{.method = method, .density = density};
      const auto keep = keep_inliers(cloud, scan_neighbors(cloud, 10), options);
      EXPECT_GE(std::count(keep.begin(), keep.begin() + 2000, 1), 1960);
      EXPECT_LE(std::count(keep.begin() + 2000, keep.end(), 1), 2);
    }
  }
}

TEST(OutlierRemoval, CanBeSwitchedOffAndTakesEmptyClouds) {
  const PointCloud cloud = sheet_with_outliers(20);
  const auto keep = keep_inliers(cloud, scan_neighbors(cloud, 10), {.method = OutlierMethod::none});
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 1), 2020);
  EXPECT_TRUE(keep_inliers({}, scan_neighbors({}, 10), {}).empty());
}

}  // namespace
}  // namespace tilth
