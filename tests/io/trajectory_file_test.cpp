#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/input_file.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth {
namespace {

Trajectory random_trajectory() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Trajectory trajectory;
  for (int i = 0; i < 200; ++i) {
    Vector6d xi;
    for (double& value : xi) value = 3 * uniform(random);
    StampedPose pose{1700000000.0 + 0.1 * i + 0.04 * uniform(random), exp(xi)};
    pose.T_world_lidar.translation() *= std::pow(10.0, 3 * uniform(random));
    trajectory.push_back(pose);
  }
  return trajectory;
}

TEST(Tum, ReadsBackExactly) {
  const TemporaryFolder folder;
  const Trajectory trajectory = random_trajectory();
  write_tum(folder / "a.tum", trajectory);
  const Trajectory back = read_tum(folder / "a.tum");
  ASSERT_EQ(back.size(), trajectory.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].stamp, trajectory[i].stamp);
    EXPECT_EQ(back[i].T_world_lidar.translation(), trajectory[i].T_world_lidar.translation());
    EXPECT_LT((back[i].T_world_lidar.linear() - trajectory[i].T_world_lidar.linear()).norm(), 1e-14);
  }
}

TEST(Tum, GoldenLine) {
  const TemporaryFolder folder;
  Trajectory trajectory(2);
  trajectory[1].stamp = 1.5;
  trajectory[1].T_world_lidar.translation() = Eigen::Vector3d(1, -0.1, 1e-9);
  write_tum(folder / "a.tum", trajectory);
  EXPECT_EQ(as_text(read_file(folder / "a.tum")), "0.000000000 0 0 0 0 0 0 1\n1.500000000 1 -0.1 1e-09 0 0 0 1\n");
}

TEST(Tum, CommentsCommasBlankLinesAndCarriageReturns) {
  const Trajectory trajectory = parse_tum("# t x y z\r\n\r\n1, 2, 3, 4, 0, 0, 0, 1.04\r\n\t 2 0 0 0 0 0 1 0", "a.tum");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].T_world_lidar.translation(), Eigen::Vector3d(2, 3, 4));
  EXPECT_TRUE(trajectory[0].T_world_lidar.linear().isIdentity(1e-15)) << "the quaternion is normalised";
  EXPECT_EQ(trajectory[1].T_world_lidar.linear()(0, 0), -1);
}

TEST(Tum, ErrorsNameFileAndLine) {
  const auto refuse = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { parse_tum(text, "a.tum"); }, parts);
  };
  refuse("", {"a.tum", "no pose"});
  refuse("# only a comment\n", {"a.tum", "no pose"});
  refuse("#\n1 2 3 4 5 6 7\n", {"a.tum, line 2", "has 7 values, expected 8"});
  refuse("1 0 0 nan 0 0 0 1\n", {"a.tum, line 1", "'nan' is not a finite number"});
  refuse("1 0 0 0x 0 0 0 1\n", {"a.tum, line 1, field 4 (tz)", "'0x'"});
  refuse("1 0 0 0 0 0 0 0\n", {"line 1", "quaternion of length zero"});
  refuse("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", {"line 2", "stamp 1", "not after"});
  refuse("2 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", {"line 2", "not after"});
  expect_error([] { read_tum("/nowhere/a.tum"); }, {"/nowhere/a.tum", "No such file"});
}

TEST(Tum, FullDiskIsReported) {
  expect_error([] { write_tum("/dev/full", random_trajectory()); }, {"/dev/full", "No space left on device"});
  expect_error([] { write_kitti_poses("/dev/full", random_trajectory()); }, {"/dev/full", "No space left on device"});
}

TEST(KittiPoses, ReadBackExactly) {
  const TemporaryFolder folder;
  const Trajectory trajectory = random_trajectory();
  write_kitti_poses(folder / "a.txt", trajectory);
  const std::vector<Pose> back = read_kitti_poses(folder / "a.txt");
  ASSERT_EQ(back.size(), trajectory.size());
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_EQ(back[i].matrix(), trajectory[i].T_world_lidar.matrix());
}

TEST(KittiPoses, WhatIsNoRotationIsRefused) {
  expect_error([] { parse_kitti_poses("1 0 0 0 0 1 0 0 0 0 2 0\n", "p.txt"); }, {"p.txt, line 1", "no rotation"});
  expect_error([] { parse_kitti_poses("1 0 0 0 0 1 0 0 0 0 -1 0\n", "p.txt"); }, {"p.txt, line 1", "no rotation"});
  expect_error([] { parse_kitti_poses("1 0 0 0 0 1 0 0 0 0 1\n", "p.txt"); }, {"line 1", "has 11 values, expected 12"});
}

}  // namespace
}  // namespace tilth
