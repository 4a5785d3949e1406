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

}  // namespace
}  // namespace tilth
