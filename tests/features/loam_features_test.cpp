// FLOAM's and LIO-SAM's features on made-up rings: a corner, walls, an edge of occlusion, a jagged ring, a short one.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/features/floam_features.hpp>
#include <tilth/features/lio_sam_features.hpp>

namespace tilth {
namespace {

using RangeAt = std::function<double(int i)>;

// One ring, a point every 0.2 degrees, the middle one straight ahead.
PointCloud ring_of(int points, const RangeAt& range) {
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const double a = (i - points / 2) * 0.2 * std::numbers::pi / 180;
    cloud.points.emplace_back(range(i) * std::cos(a), range(i) * std::sin(a), 0.0);
    cloud.rings.push_back(0);
  }
  return cloud;
}

// Within a sector of the ring: sectors choose by themselves.
int bend_of(int points) {
  return points / 2 + 15;
}

// Two walls at right angles, their corner `distance` [m] away.
RangeAt corner(int points, double distance) {
  return [=](int i) {
    const double a = std::abs(i - bend_of(points)) * 0.2 * std::numbers::pi / 180;
    return distance * std::sin(std::numbers::pi / 4) / std::sin(std::numbers::pi / 4 + a);
  };
}

// A wall that is 1 m farther away from the bend on.
RangeAt step(int points) {
  return [=](int i) { return i < bend_of(points) ? 5.0 : 6.0; };
}

RangeAt jagged(double low, double high) {
  return [=](int i) { return i % 2 == 0 ? low : high; };
}

TEST(Curvature, FollowsEachFormula) {
  std::vector<Eigen::Vector3d> ring;  // five points each way from a corner at (3, 4, 0), 0.1 m apart
  for (int k = -5; k < 0; ++k) ring.emplace_back(3 + 0.1 * k, 4, 0);
  for (int k = 0; k <= 5; ++k) ring.emplace_back(3, 4 + 0.1 * k, 0);
  EXPECT_NEAR(curvature(ring, Curvature::floam)[5], 2 * 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(curvature(ring, Curvature::loam)[5], 1.5 * std::sqrt(2.0) / (10 * 5), 1e-12);
  double sum = 0;
  for (const Eigen::Vector3d& p : ring) sum += p.norm() - 5;
  EXPECT_NEAR(curvature(ring, Curvature::lio_sam)[5], sum * sum, 1e-5);
  for (const std::size_t i : {0, 4, 6, 10}) EXPECT_EQ(curvature(ring, Curvature::floam)[i], 0.0);
}

TEST(FloamFeatures, TakeAWallAsPlaneButForFiveAtEitherEnd) {
  for (const double range : {3.0, 50.0}) {
    const FeatureClouds features = floam_features(ring_of(200, [=](int) { return range; }), {});
    EXPECT_TRUE(features.edges.empty());
    EXPECT_EQ(features.planes.size(), 190u);
  }
}

TEST(FloamFeatures, CanSkipTheLastPointOfEachSectorAsTheOriginal) {
  const PointCloud ring = ring_of(200, [](int) { return 5.0; });
  EXPECT_EQ(floam_features(ring, {.skip_sector_ends = true}).planes.size(), 184u);
}

TEST(FloamFeatures, ByACurvatureGivenAreTheMostAndTheLeastCurvedOfEachSector) {
  const PointCloud ring = ring_of(610, [](int) { return 5.0; });
  std::vector<double> given(610);
  for (std::size_t i = 0; i < given.size(); ++i) given[i] = i % 50 == 25 ? 1.7 : 1 + 1e-4 * double(i % 100);
  const FeatureIndices chosen = choose_floam_features(ring, given, {.edge_threshold = 0, .edges = 2, .planes = 4});
  ASSERT_EQ(chosen.edges.size(), 12u);
  ASSERT_EQ(chosen.planes.size(), 24u);
  for (const std::uint32_t i : chosen.edges) EXPECT_EQ(given[i], 1.7);
  EXPECT_TRUE(std::is_sorted(chosen.planes.begin(), chosen.planes.end()));
  double most = 0;
  for (std::size_t k = 0; k < 4; ++k) most = std::max(most, given[chosen.planes[k]]);
  std::size_t flatter = 0;
  for (std::size_t i = 5; i < 105; ++i) flatter += given[i] <= most;
  EXPECT_EQ(flatter, 4u);
}

TEST(FloamFeatures, LeaveRingsOfLessThan131PointsOut) {
  const auto wall = [](int) { return 5.0; };
  EXPECT_TRUE(floam_features(ring_of(130, wall), {}).planes.empty());
  EXPECT_EQ(floam_features(ring_of(131, wall), {}).planes.size(), 121u);
  EXPECT_TRUE(floam_features({}, {}).planes.empty());
}

TEST(FloamFeatures, SeeACornerFarAwayButNoneNear) {
  const PointCloud far = ring_of(220, corner(220, 5.0));
  const FeatureClouds features = floam_features(far, {});
  ASSERT_EQ(features.edges.size(), 1u);
  EXPECT_LT((features.edges.points[0] - far.points[std::size_t(bend_of(220))]).norm(), 1e-12);
  EXPECT_EQ(features.planes.size(), 210u - 11u);  // five on either side are neither
  EXPECT_TRUE(floam_features(ring_of(220, corner(220, 2.0)), {}).edges.empty());
}

TEST(FloamFeatures, SeeACornerAtEveryDistanceByLoamsCurvature) {
  for (const double distance : {2.0, 5.0}) {
    const PointCloud ring = ring_of(220, corner(220, distance));
    const FloamFeatureOptions options{.curvature = Curvature::loam, .edge_threshold = 0.005};
    EXPECT_EQ(floam_features(ring, options).edges.size(), 1u) << distance;
  }
}

TEST(FloamFeatures, TakeBothSidesOfAnOcclusion) {
  // The gap of 1 m ends what either edge point rules out.
  const FeatureClouds features = floam_features(ring_of(220, step(220)), {});
  ASSERT_EQ(features.edges.size(), 2u);
  EXPECT_EQ(features.planes.size(), 210u - 2 * 6u);
}

TEST(FloamFeatures, TakeAtMostTwentyEdgesASector) {
  const PointCloud ring = ring_of(610, jagged(5.0, 6.0));
  const FeatureClouds features = floam_features(ring, {});
  EXPECT_EQ(features.edges.size(), 6u * 20u);
  EXPECT_EQ(features.planes.size(), 600u - 120u);  // all that is no edge, whatever its curvature
  EXPECT_EQ(floam_features(ring, {.edges = 7}).edges.size(), 42u);
}

TEST(LioSamFeatures, TakeTheNearSideOfAnOcclusionOnly) {
  const PointCloud ring = ring_of(900, step(900));
  const FeatureClouds features = lio_sam_features(ring, {});
  ASSERT_EQ(features.edges.size(), 1u);
  EXPECT_LT((features.edges.points[0] - ring.points[std::size_t(bend_of(900) - 1)]).norm(), 1e-12);
}

TEST(LioSamFeatures, TakeNoEdgeOfAPointThatStandsAlone) {
  EXPECT_TRUE(lio_sam_features(ring_of(900, jagged(5.0, 5.2)), {}).edges.empty());  // 4 % from both neighbours
}

TEST(LioSamFeatures, TakeAtMostTwentyEdgesASectorEachSixApart) {
  // Steps of 0.2 m at 20 m: curvature (6 x 0.2)^2 = 1.44 everywhere.
  const PointCloud ring = ring_of(1800, jagged(20.0, 20.2));
  const FeatureClouds features = lio_sam_features(ring, {.plane_voxel = 0.01});
  EXPECT_EQ(features.edges.size(), 6u * 20u);
  EXPECT_EQ(features.planes.size(), 1789u - 120u);
  EXPECT_TRUE(lio_sam_features(ring, {.edge_threshold = 1.45}).edges.empty());
  // 600 points: sectors of 98 points hold 16 or 17 edges six apart.
  const std::size_t edges = lio_sam_features(ring_of(600, jagged(20.0, 20.2)), {}).edges.size();
  EXPECT_GE(edges, 6u * 16u);
  EXPECT_LE(edges, 6u * 17u);
}

TEST(LioSamFeatures, KeepTheFirstPointOfACellAndThinThePlanes) {
  PointCloud ring = ring_of(900, [](int) { return 5.0; });
  append(ring, ring_of(900, [](int) { return 9.0; }));
  const FeatureClouds features = lio_sam_features(ring, {});
  EXPECT_TRUE(features.edges.empty());
  for (const Eigen::Vector3d& p : features.planes.points) EXPECT_LT(p.norm(), 5.01);
  const double length = 5 * std::numbers::pi;
  EXPECT_GT(double(features.planes.size()), length / 0.2);
  EXPECT_LT(double(features.planes.size()), 2 * length / 0.2);
}

}  // namespace
}  // namespace tilth
