// Which keyframes make the local map, and where their points lie in it.
#include <gtest/gtest.h>

#include <tilth/map/keyframe_map.hpp>

namespace tilth {
namespace {

using Numbers = std::vector<std::uint32_t>;

Pose at(double x, double y = 0.0) {
  return Pose(Eigen::Translation3d(x, y, 0));
}

PointCloud point(double x) {
  PointCloud cloud;
  cloud.points = {{x, 0, 0}};
  cloud.intensities = {1.0f};
  return cloud;
}

// One keyframe a second and `step` metres.
KeyframeMap map_of_straight_path(const KeyframeMapOptions& options, int keyframes, double step) {
  KeyframeMap map(options);
  for (int i = 0; i < keyframes; ++i) map.insert(i, at(0.05 + step * i), {point(0), point(0)});
  return map;
}

TEST(KeyframeMap, TakesKeyframesWithinTheRadius) {
  const KeyframeMap map = map_of_straight_path({.search_radius = 50, .density = 1}, 100, 1.0);
  const Numbers numbers = map.surrounding(Eigen::Vector3d(0.05, 0, 0), 100);
  ASSERT_EQ(numbers.size(), 51u);  // 0 .. 50 m
  EXPECT_EQ(numbers.back(), 50u);
}

TEST(KeyframeMap, TakesOneKeyframeACellNearestToTheirMean) {
  const KeyframeMap map = map_of_straight_path({.density = 1}, 20, 0.3);
  // cells of 0.05 .. 0.95, 1.25 .. 1.85, 2.15 .. 2.75, 3.05 .. 3.95, 4.25 .. 4.85, 5.15 .. 5.75
  EXPECT_EQ(map.surrounding(Eigen::Vector3d::Zero(), 100), (Numbers{1, 5, 8, 11, 15, 18}));
}

// Two passes through one cell: the mean of their numbers is a place that neither of them has been near.
TEST(KeyframeMap, MeansOfNumbersMissAfterARevisit) {
  for (const bool average : {true, false}) {
    KeyframeMap map({.search_radius = 5, .density = 1, .average_indices = average});
    for (int i = 0; i <= 500; ++i) {
      const bool here = i == 10 || i == 500;
      map.insert(i, here ? at(0.5, 0.5) : at(1000.0 + i), {point(0), point(0)});
    }
    EXPECT_EQ(map.surrounding(Eigen::Vector3d(0.4, 0.4, 0), 1000), (Numbers{average ? 255u : 10u}));
  }
}

TEST(KeyframeMap, AddsTheRecentOnesAgain) {
  const KeyframeMap map = map_of_straight_path({.search_radius = 2.5, .density = 0.1, .recent = 3}, 10, 1.0);
  EXPECT_EQ(map.surrounding(Eigen::Vector3d(9.05, 0, 0), 9.0), (Numbers{7, 8, 9, 7, 8, 9}));
  EXPECT_EQ(map.surrounding(Eigen::Vector3d(0.05, 0, 0), 9.0), (Numbers{0, 1, 2, 7, 8, 9}));
}

TEST(KeyframeMap, JoinsPointsInTheFrameOfTheMap) {
  KeyframeMap map({});
  const Pose turned = at(1, 2) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  map.insert(0, turned, {point(3), point(4)});
  map.insert(1, at(10), {point(5), {}});
  const FeatureClouds all = map.joined(Numbers{1, 0});
  ASSERT_EQ(all.edges.size(), 2u);
  EXPECT_TRUE(all.edges.points[0].isApprox(Eigen::Vector3d(15, 0, 0)));
  EXPECT_TRUE(all.edges.points[1].isApprox(Eigen::Vector3d(1, 5, 0)));
  ASSERT_EQ(all.planes.size(), 1u);
  EXPECT_TRUE(all.planes.points[0].isApprox(Eigen::Vector3d(1, 6, 0)));
  EXPECT_TRUE(all.edges.intensities.empty());
}

TEST(KeyframeMap, IsEmptyBeforeTheFirst) {
  const KeyframeMap map({});
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(map.surrounding(Eigen::Vector3d::Zero(), 0).empty());
  EXPECT_TRUE(map.joined({}).planes.empty());
}

}  // namespace
}  // namespace tilth
