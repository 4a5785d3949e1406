#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <tilth/run/map_builder.hpp>

namespace tilth {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d point_of(const PointRecords& records, std::size_t index) {
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = column(records, records.fields[std::size_t(axis)])[index];
  return p;
}

PointCloud cloud_of(const std::vector<Eigen::Vector3d>& points) {
  PointCloud cloud;
  cloud.points = points;
  return cloud;
}

TEST(MapBuilder, IsThinnedEvenlyForALook) {
  MapBuilder map(MapOptions{.voxel = 0.5});
  PointCloud line;
  for (int i = 0; i < 1000; ++i) line.points.emplace_back(i, 0, 0);
  map.add(line, Pose::Identity(), 0.0, {}, {0.0, true});
  for (const std::size_t most : {1, 7, 100, 999, 1000, 5000}) {
    const PointRecords some = map.thinned_records(most);
    EXPECT_LE(some.count, most);
    EXPECT_GT(2 * some.count, std::min<std::size_t>(most, 1000)) << most;
  }
  EXPECT_EQ(MapBuilder(MapOptions{}).thinned_records(10).count, 0U);
}

TEST(MapBuilder, KeepsTheFirstPointOfEachVoxel) {
  MapBuilder map({.voxel = 1.0});
  map.add(cloud_of({{0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}, {1.2, 0.2, 0.2}, {-0.2, 0.2, 0.2}}), Pose::Identity(), 0.0, {});
  ASSERT_EQ(map.size(), 3U);
  EXPECT_TRUE(point_of(map.records(), 0).isApprox(Eigen::Vector3d(0.2, 0.2, 0.2), 1e-6));
  EXPECT_TRUE(point_of(map.records(), 2).isApprox(Eigen::Vector3d(-0.2, 0.2, 0.2), 1e-6));
}

TEST(MapBuilder, MovesPointsIntoTheWorld) {
  MapBuilder map({.voxel = 0.1});
  const Pose T_world_lidar = Eigen::Translation3d(5, 0, 1) * Pose(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()));
  map.add(cloud_of({{2, 3, 4}}), T_world_lidar, 0.0, {});
  EXPECT_TRUE(point_of(map.records(), 0).isApprox(T_world_lidar * Eigen::Vector3d(2, 3, 4), 1e-6));
}

TEST(MapBuilder, UndoesTheMotionWithinAScan) {
  const Pose T_world_lidar(Eigen::Translation3d(1, 2, 3));
  Vector6d velocity;
  velocity << 0.3, -0.2, 2.5, 8.0, -1.0, 0.4;
  for (const float time : {0.0F, 0.013F, 0.0777F, 0.1F}) {
    PointCloud cloud = cloud_of({{40, -30, 2}, {1, 1, 1}});
    cloud.times = {time, 0.1F};
    MapBuilder map({.voxel = 0.01});
    map.add(cloud, T_world_lidar, 0.05, {velocity});
    const Eigen::Vector3d expected = T_world_lidar * exp(velocity * (double(time) - 0.05)) * cloud.points[0];
    EXPECT_LT((point_of(map.records(), 0) - expected).norm(), 1e-4) << time;
  }
}

TEST(MapBuilder, MovesThePointsOfEachScanByItsOwnMotion) {
  MapBuilder map({.voxel = 0.1});
  const MotionInScan rest;
  map.add(cloud_of({{1, 0, 0}, {2, 0, 0}}), Pose::Identity(), 0.0, rest);
  map.add(cloud_of({{1.5, 0, 0}, {3, 0, 0}}), Pose::Identity(), 0.0, rest);
  const Pose up(Eigen::Translation3d(0, 0, 5)), back(Eigen::Translation3d(-0.5, 0, 5));
  map.move(std::vector<Pose>{up, back});
  ASSERT_EQ(map.size(), 3U);  // 1.5 falls onto 1
  EXPECT_TRUE(point_of(map.records(), 0).isApprox(Eigen::Vector3d(1, 0, 5), 1e-6));
  EXPECT_TRUE(point_of(map.records(), 1).isApprox(Eigen::Vector3d(2, 0, 5), 1e-6));
  EXPECT_TRUE(point_of(map.records(), 2).isApprox(Eigen::Vector3d(2.5, 0, 5), 1e-6));
}

TEST(MapBuilder, PassesOverPointsThatAreNotFinite) {
  MapBuilder map({.voxel = 0.1});
  const double infinity = std::numeric_limits<double>::infinity();
  map.add(cloud_of({{kNan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}, {1, 1, 1}}), Pose::Identity(), 0.0, {});
  EXPECT_EQ(map.size(), 1U);
}

TEST(MapBuilder, DoublesItsVoxelsRatherThanGrowPastItsBound) {
  MapBuilder map({.voxel = 0.1, .max_points = 1000});
  for (int i = 0; i < 100; ++i) {
    PointCloud cloud;
    for (int k = 0; k < 100; ++k) cloud.points.emplace_back(0.15 * i, 0.15 * k, 0.0);
    map.add(cloud, Pose::Identity(), 0.0, {});
    ASSERT_LE(map.size(), 1000U);
  }
  EXPECT_GT(map.size(), 100U);
  EXPECT_DOUBLE_EQ(map.voxel(), 0.8);
}

TEST(MapBuilder, KeepsOnePointAVoxelWhileItsTableGrows) {
  MapBuilder map({.voxel = 0.1});
  PointCloud cloud;
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < 300; ++k) cloud.points.emplace_back(0.1 * i + 0.05, 0.1 * k + 0.05, 0.05);
  }
  for (int repeat = 0; repeat < 2; ++repeat) map.add(cloud, Pose::Identity(), 0.0, {});
  EXPECT_EQ(map.size(), 90'000U);
}

TEST(MapBuilder, HasIntensityWhereTheCloudHas) {
  MapBuilder map({.voxel = 0.1});
  PointCloud cloud = cloud_of({{1, 1, 1}});
  cloud.intensities = {42.0F};
  map.add(cloud, Pose::Identity(), 0.0, {});
  const PointRecords records = map.records();
  EXPECT_EQ(column(records, *records.find("intensity"))[0], 42.0);
}

/// A wall at x = 5, with a board before it at x = 3 where `board`.
PointCloud wall(bool board) {
  PointCloud cloud;
  for (double y = -1.2; y < 1.2; y += 0.007) {
    for (double z = -0.4; z < 0.4; z += 0.05) {
      const double x = board && std::abs(y) < 0.3 ? 3.03 : 5.03;
      cloud.points.emplace_back(x, y * x / 5, z * x / 5);
    }
  }
  return cloud;
}

MapBuilder map_of_wall(const MapOptions& options, bool trusted) {
  MapBuilder map(options);
  for (int scan = 0; scan < 80; ++scan) map.add(wall(scan < 10), Pose::Identity(), 0.0, {}, {0.1 * scan, trusted});
  return map;
}

std::size_t points_near(const std::vector<MapPoint>& points, float x) {
  return std::size_t(
      std::count_if(points.begin(), points.end(), [x](const MapPoint& p) { return std::abs(p.x - x) < 0.5F; }));
}

TEST(MapBuilder, TakesOutWhatLeft) {
  MapBuilder map = map_of_wall({.voxel = 0.1}, true);
  const std::size_t before = map.records().count;
  map.settle();
  EXPECT_GT(points_near(map.moving(), 3), 20U);
  EXPECT_EQ(points_near(map.moving(), 5), 0U);
  EXPECT_LT(points_near(map.points(), 3), 3U);
  EXPECT_GT(points_near(map.points(), 5), 200U);
  EXPECT_LT(before, map.points().size() + map.moving().size() / 10);  // the records leave it out before, too
  EXPECT_EQ(map.size(), map.points().size());
}

TEST(MapBuilder, LeavesWhatMovesWhereThatIsAskedForAndWherePosesAreNotBelieved) {
  for (MapBuilder map : {map_of_wall({.voxel = 0.1, .keep_moving = true}, true), map_of_wall({.voxel = 0.1}, false)}) {
    map.settle();
    EXPECT_EQ(map.moving().size(), 0U);
    EXPECT_GT(points_near(map.points(), 3), 20U);
  }
}

TEST(MapBuilder, HoldsWhatStandsWhereSomethingWent) {
  MapBuilder map({.voxel = 0.1});
  double stamp = 0.0;
  const auto add = [&](bool board) { map.add(wall(board), Pose::Identity(), 0.0, {}, {stamp += 0.1, true}); };
  for (int i = 0; i < 10; ++i) add(true);
  for (int i = 0; i < 60; ++i) add(false);
  for (int i = 0; i < 60; ++i) add(true);  // another board comes, and stays
  map.settle();
  EXPECT_GT(points_near(map.points(), 3), 20U);
  EXPECT_GT(points_near(map.moving(), 3), 20U);
}

TEST(MapBuilder, MovesWhatMovedAsWell) {
  MapBuilder map = map_of_wall({.voxel = 0.1}, true);
  map.move(std::vector<Pose>(80, Pose(Eigen::Translation3d(10, 0, 0))));
  EXPECT_GT(points_near(map.moving(), 13), 20U);
  EXPECT_GT(points_near(map.points(), 15), 200U);
}

}  // namespace
}  // namespace tilth
