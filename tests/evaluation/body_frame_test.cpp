// How a body moves in its own frame, whatever the world's.
#include <random>

#include <gtest/gtest.h>

#include "made_trajectories.hpp"
#include <tilth/evaluation/body_frame.hpp>

namespace tilth {
namespace {

/// Of x forward, y left, z up, on a body of z forward, x right, y down: a camera under a LiDAR.
Pose camera_lidar() {
  Pose T = Pose::Identity();
  T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T.translation() = Eigen::Vector3d(0.1, -0.2, 0.3);
  return T;
}

TEST(ForwardDirection, IsTheBodysOwn) {
  const Trajectory lidar = test::moved(test::random_walk(400, 1), test::some_pose());
  const auto forward = forward_direction(lidar);
  ASSERT_TRUE(forward);
  EXPECT_GT(forward->x(), 0.99);
  const auto of_camera = forward_direction(in_frame_of(lidar, camera_lidar().inverse()));
  ASSERT_TRUE(of_camera);
  EXPECT_GT(of_camera->z(), 0.99);
}

TEST(ForwardDirection, SurvivesNoiseOfAHighRate) {
  Trajectory dense;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.02);
  for (int i = 0; i < 4000; ++i) {
    dense.push_back({0.005 * i, Pose(Eigen::Translation3d(0.005 * i + noise(random), noise(random), noise(random)))});
  }
  const auto forward = forward_direction(dense);
  ASSERT_TRUE(forward);
  EXPECT_GT(forward->x(), 0.99);
}

TEST(ForwardDirection, IsNoneAtRestAndBackAndForth) {
  EXPECT_FALSE(forward_direction({}));
  EXPECT_FALSE(forward_direction(test::straight_line(50, 0.0)));
  Trajectory there_and_back = test::straight_line(50, 0.4);
  for (std::size_t i = 25; i < 50; ++i) there_and_back[i].T_world_lidar.translation().x() = 0.4 * double(50 - i);
  EXPECT_FALSE(forward_direction(there_and_back));
}

TEST(InFrameOf, MovesThereAndBack) {
  const Trajectory lidar = test::random_walk(50, 2);
  const Trajectory back = in_frame_of(in_frame_of(lidar, camera_lidar().inverse()), camera_lidar());
  for (std::size_t i = 0; i < lidar.size(); ++i)
    EXPECT_TRUE(back[i].T_world_lidar.isApprox(lidar[i].T_world_lidar, 1e-12));
}

TEST(InFrameOf, KeepsTheDistanceOfTheTwoBodies) {
  const Trajectory lidar = test::random_walk(50, 3), camera = in_frame_of(lidar, camera_lidar().inverse());
  for (std::size_t i = 0; i < lidar.size(); ++i) {
    // The camera's world is the LiDAR's seen from the camera's first pose.
    const Pose T_world_camera = camera_lidar().inverse() * camera[i].T_world_lidar;
    EXPECT_TRUE(T_world_camera.isApprox(lidar[i].T_world_lidar * camera_lidar().inverse(), 1e-12));
  }
}

}  // namespace
}  // namespace tilth
