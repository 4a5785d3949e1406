// Trajectories with known answers, for the tests of the judge.
#pragma once

#include <random>

#include <tilth/core/trajectory.hpp>

namespace tilth::test {

/// A pose each second from 0, each `step` [m] on along x, not turning.
inline Trajectory straight_line(std::size_t n, double step) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < n; ++i) {
    trajectory.push_back({double(i), Pose(Eigen::Translation3d(step * double(i), 0, 0))});
  }
  return trajectory;
}

/// A pose each 0.1 s on a random walk in space.
inline Trajectory random_walk(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> turn(0, 0.1), step(0.2, 0.05);
  Trajectory trajectory{{0.0, Pose::Identity()}};
  for (std::size_t i = 1; i < n; ++i) {
    Vector6d motion;
    motion << turn(random), turn(random), turn(random), step(random), 0, 0;
    trajectory.push_back({0.1 * double(i), retract(trajectory.back().T_world_lidar, motion)});
  }
  return trajectory;
}

inline Pose some_pose() {
  Vector6d xi;
  xi << 0.3, -1.1, 2.0, 10, -20, 30;
  return exp(xi);
}

/// The same motion, described in another world frame.
inline Trajectory moved(Trajectory trajectory, const Pose& T) {
  for (StampedPose& pose : trajectory) pose.T_world_lidar = T * pose.T_world_lidar;
  return trajectory;
}

inline Trajectory shifted(Trajectory trajectory, double seconds) {
  for (StampedPose& pose : trajectory) pose.stamp += seconds;
  return trajectory;
}

}  // namespace tilth::test
