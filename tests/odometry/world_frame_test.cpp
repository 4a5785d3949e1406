// The frame of the first scan, which is laid anew once the map has grown.
#include <gtest/gtest.h>

#include <tilth/odometry/world_frame.hpp>

namespace tilth {
namespace {

const ScanPatches kFirst{.stamp = 10, .duration = 0.1, .patches = {{.mean = {5, 0, 0}, .time = 0.1f}}};

TEST(WorldFrame, IsLaidOnceWhereTheFirstScanIsFound) {
  WorldFrame world(4.0);
  EXPECT_TRUE(world.empty());
  EXPECT_EQ(world.age(100), 0.0);
  world.begin(kFirst);
  EXPECT_FALSE(world.empty());
  EXPECT_TRUE(world.awaits_second());
  EXPECT_FALSE(world.is_due(20)) << "nothing tells how the first scan was taken";
  world.add_second({.interval = -0.1, .known = true});
  EXPECT_FALSE(world.awaits_second());
  EXPECT_NEAR(world.age(12.05), 2.0, 1e-9) << "from the middle of the first scan";
  EXPECT_FALSE(world.is_due(14.0));
  ASSERT_TRUE(world.is_due(14.06));
  const MotionPrior prior = world.prior_of_first({.tilt = 1e-3, .yaw = 1e-3, .translation = 1e-3});
  EXPECT_EQ(prior.interval, -0.1);
  EXPECT_EQ(prior.vibration.tilt, 1e-3) << "as it is known by then";
  const Pose T_map_first(Eigen::Translation3d(0.01, 0, 0));
  world.anchor(14.06, T_map_first);
  EXPECT_TRUE((world.T_world_map() * T_map_first).isApprox(Pose::Identity()));
  EXPECT_FALSE(world.is_due(30)) << "once";
}

TEST(WorldFrame, StaysWhereTheFirstScanIsNotFound) {
  WorldFrame world(4.0);
  world.begin(kFirst);
  world.add_second({});
  world.anchor(14.06, std::nullopt);
  EXPECT_EQ(world.T_world_map().matrix(), Pose::Identity().matrix());
  EXPECT_FALSE(world.is_due(30));
}

TEST(WorldFrame, FollowsTheThinMapOfAStartInMotionForASecond) {
  WorldFrame world(4.0);
  world.begin(kFirst);
  world.add_second({.velocity = (Vector6d() << 0, 0, 0, 8, 0, 0).finished()});
  for (const double time : {10.2, 10.9}) {
    EXPECT_TRUE(world.is_due(time));
    world.anchor(time, std::nullopt);
  }
  EXPECT_FALSE(world.is_due(12.0));
  EXPECT_TRUE(world.is_due(14.1));
}

TEST(WorldFrame, BeginsWhereItIsTold) {
  const Pose T_world_map(Eigen::Translation3d(7, 0, 0));
  EXPECT_EQ(WorldFrame(4.0, T_world_map).T_world_map().matrix(), T_world_map.matrix());
}

TEST(WorldFrame, StraightensTheFirstScanByTheMotionInIt) {
  WorldFrame world(4.0);
  world.begin(kFirst);
  const SurfacePatches straight = world.first_patches((Vector6d() << 0, 0, 0, 2, 0, 0).finished());
  EXPECT_LT((straight[0].mean - Eigen::Vector3d(5.1, 0, 0)).norm(), 1e-6) << "half a scan later the LiDAR is 0.1 m on";
}

}  // namespace
}  // namespace tilth
