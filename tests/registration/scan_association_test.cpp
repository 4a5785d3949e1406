// What the points of a scan are matched with: rows, distances, the search cut short, weights.
#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/registration/scan_association.hpp>

namespace tilth {
namespace {

constexpr auto kNone = ScanTarget::kNone;
using Match = ScanTarget::Match;

PointCloud cloud_of(const std::vector<Eigen::Vector3d>& points, const std::vector<std::uint16_t>& rows) {
  PointCloud cloud;
  cloud.points = points;
  cloud.rings = rows;
  return cloud;
}

TEST(ScanTarget, FindsTheNearestOfTheSameAndOfAnotherRowWithinTwo) {
  const ScanTarget target(
      cloud_of({{5, 0, 0}, {5, 0, 1}, {5, 0.5, 2}, {5, 0, 2}, {5, 0, 4}, {5, 0, 4.5}}, {0, 1, 3, 3, 5, 6}));
  EXPECT_EQ(target.match_at({5, 0, 2.1}, {}, 6), (Match{3, 2, 1}));  // rows 1 .. 5
  EXPECT_EQ(target.match_at({5, 0, 3.6}, {}, 6), (Match{4, kNone, 5}));
  EXPECT_EQ(target.match_at({5, 0, -0.2}, {}, 6), (Match{0, kNone, 1}));
}

TEST(ScanTarget, LooksNoFartherThanFiveMetres) {
  const ScanTarget target(cloud_of({{0, 0, 0}, {0, 0, 2}}, {0, 1}));
  EXPECT_EQ(target.match_at({4.99, 0, 0}, {}, 2), (Match{0, kNone, kNone}));
  EXPECT_EQ(target.match_at({4.5, 0, 0}, {}, 2), (Match{0, kNone, 1}));
  EXPECT_EQ(target.match_at({5.01, 0, 0}, {}, 2), (Match{kNone, kNone, kNone}));
  EXPECT_EQ(ScanTarget(PointCloud()).match_at({0, 0, 0}, {}, 0), (Match{kNone, kNone, kNone}));
}

TEST(ScanTarget, CutShortSeesWhatLiesBelowButNotAbove) {
  const ScanTarget target(cloud_of({{5, 0, 0}, {5, 0, 1}, {5, 0, 1.2}, {5, 0, 2}}, {0, 1, 1, 2}));
  EXPECT_EQ(target.match_at({5, 0, 1.05}, {}, 4), (Match{1, 2, 3}));
  EXPECT_EQ(target.match_at({5, 0, 1.05}, {}, 2), (Match{1, kNone, 0}));
}

TEST(ScanTarget, AsksForRowsInOrder) {
  EXPECT_THROW(ScanTarget(cloud_of({{1, 0, 0}, {2, 0, 0}}, {1, 0})), Error);
  EXPECT_THROW(ScanTarget(cloud_of({{1, 0, 0}}, {})), Error);
}

// 0.6 m off a pole: no weight after the first five iterations, since 1 - 1.8 x 0.6 is below 0.1.
TEST(ScanPairs, HaveWeightsFromTheSixthIterationOn) {
  const ScanTarget target(cloud_of({{5, 0, 0}, {5, 0, 1}}, {0, 1}));
  PointCloud edges = cloud_of({{4.4, 0, 0.1}, {4.9, 0, 0.1}}, {0, 0});
  edges.times = {0.05f, 0.1f};
  const ScanMatchOptions options;
  ScanPairs<PointToLine> lines({&edges, 0.1}, target, options);
  for (int iteration = 0; iteration < 5; ++iteration) EXPECT_EQ(lines(Pose::Identity()).size(), 2u);
  const auto pairs = lines(Pose::Identity());
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].residual(Pose::Identity()).norm(), 0.1 * (1 - 1.8 * 0.1), 1e-6);
}

TEST(ScanPairs, OfPlanesWeighByTheRootOfTheRange) {
  const ScanTarget target(cloud_of({{8.8, 0, -1}, {9, 0.3, -1}, {9.5, 0, -1}}, {0, 0, 1}));
  PointCloud planes = cloud_of({{9, 0, -0.4}}, {0});
  planes.times = {0.1f};
  const ScanMatchOptions options;
  ScanPairs<PointToPlane> pairs({&planes, 0.1}, target, options);
  for (int iteration = 0; iteration < 5; ++iteration)
    EXPECT_NEAR(pairs(Pose::Identity()).at(0).residual(Pose::Identity()).norm(), 0.6, 1e-9);
  const double range = std::hypot(9.0, 0.4);
  EXPECT_NEAR(pairs(Pose::Identity()).at(0).residual(Pose::Identity()).norm(), 0.6 * (1 - 1.8 * 0.6 / std::sqrt(range)),
              1e-9);
}

// The sensor moves by 1 m; a point measured at half time has been moved half a metre by then.
TEST(ScanPairs, GoBackToTheStartByTheShareOfTheMotion) {
  const ScanTarget target(cloud_of({{5, 0, 0}, {5, 0, 1}}, {0, 1}));
  PointCloud edges = cloud_of({{4.5, 0, 0.1}}, {0});
  edges.times = {0.05f};
  const ScanMatchOptions options;
  ScanPairs<PointToLine> lines({&edges, 0.1}, target, options);
  const Pose T_start_end(Eigen::Translation3d(1, 0, 0));
  const auto pairs = lines(T_start_end);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].residual(T_start_end).norm(), 0, 1e-6);
  EXPECT_LT((pairs[0].source - Eigen::Vector3d(4, 0, 0.1)).norm(), 1e-6);
  EXPECT_NEAR(pairs[0].ratio, 0.5, 1e-6);
}

}  // namespace
}  // namespace tilth
