// Ways of the user's own: through every way-point, without jumps in position, velocity or turn rate.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/simulation/mesh.hpp>
#include <tilth/simulation/path.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kRate = kTruthRate;

double heading(const Pose& T) {
  return std::atan2(T.linear()(1, 0), T.linear()(0, 0));
}

/// Twist [rad/s, m/s] in the world between the poses i and i + 1.
Vector6d velocity(const Trajectory& path, std::size_t i) {
  const Pose &a = path[i].T_world_lidar, &b = path[i + 1].T_world_lidar;
  Vector6d v;
  const Eigen::AngleAxisd turn(a.linear().transpose() * b.linear());
  v << turn.angle() * (a.linear() * turn.axis()), b.translation() - a.translation();
  return kRate * v;
}

struct Motion {
  double fastest = 0, turn = 0, acceleration = 0, turn_acceleration = 0;
};

Motion motion_of(const Trajectory& path) {
  Motion most;
  for (std::size_t i = 0; i + 2 < path.size(); ++i) {
    const Vector6d v = velocity(path, i), a = kRate * (velocity(path, i + 1) - v);
    most.fastest = std::max(most.fastest, v.tail<3>().norm());
    most.turn = std::max(most.turn, v.head<3>().norm());
    most.acceleration = std::max(most.acceleration, a.tail<3>().norm());
    most.turn_acceleration = std::max(most.turn_acceleration, a.head<3>().norm());
  }
  return most;
}

double distance_to(const Trajectory& path, const Vector3d& point) {
  double nearest = 1e9;
  for (const StampedPose& pose : path) nearest = std::min(nearest, (pose.T_world_lidar.translation() - point).norm());
  return nearest;
}

void expect_stamps_at_200_hz(const Trajectory& path) {
  for (std::size_t i = 0; i < path.size(); ++i) ASSERT_NEAR(path[i].stamp, double(i) / kRate, 1e-12);
}

PathOptions with_cruise(double cruise, double corner) {
  PathOptions path;
  path.cruise = cruise, path.corner = corner;
  return path;
}

TEST(Waypoints, AreReadWithAndWithoutHeight) {
  const auto points = parse_waypoints("1,2;-3.5, 4e0 ,5;0,0", 0.8);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0], Vector3d(1, 2, 0.8));
  EXPECT_EQ(points[1], Vector3d(-3.5, 4, 5));
  EXPECT_EQ(parse_waypoints("0,0;1,1;", 1).size(), 2u);
}

TEST(Waypoints, AreRefusedByName) {
  for (const char* text :
       {"", "1,2", "1,2;3", "1,2;3,4,5,6", "1,2;a,b", "1,2;3,,4", "1,2;;3,4", "1,2;nan,3", "1,2;inf,3"}) {
    EXPECT_THROW(parse_waypoints(text, 1), Error) << text;
  }
  try {
    parse_waypoints("1,2;3,x", 1);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("3,x"), std::string::npos) << error.what();
  }
}

TEST(DriveThrough, GoesStraightAtItsSpeedFromRestToRest) {
  const Trajectory path = drive_through({{0, 0, 1}, {10, 0, 1}}, with_cruise(0.5, 0.8), {});
  expect_stamps_at_200_hz(path);
  EXPECT_EQ(path.front().T_world_lidar.translation(), Vector3d(0, 0, 1));
  EXPECT_NEAR((path.back().T_world_lidar.translation() - Vector3d(10, 0, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR(velocity(path, 0).norm(), 0, 1e-3);
  EXPECT_NEAR(velocity(path, path.size() / 2).norm(), 0.5, 1e-9);
  EXPECT_NEAR(path.back().stamp, 10 / 0.5 + 1.6, 0.01);
  EXPECT_LT(motion_of(path).acceleration, 0.7);
}

TEST(DriveThrough, RoundsCornersWithoutJumps) {
  const std::vector<Vector3d> points{{0, 0, 1}, {6, 0, 1}, {6, 5, 1}, {5.2, 5, 1.4}, {0, 1, 2}};
  const Trajectory path = drive_through(points, with_cruise(1, 1), {});
  const Motion most = motion_of(path);
  EXPECT_LT(most.fastest, 1 + 1e-6);
  EXPECT_LT(most.acceleration, 4);        // a jump of the velocity would show as 200 m/s^2
  EXPECT_LT(most.turn_acceleration, 25);  // the sharpest corner has 0.4 m on either side
  for (const Vector3d& point : points) EXPECT_LT(distance_to(path, point), 0.3);
  EXPECT_LT(distance_to(path, {3, 0, 1}), 0.003);  // on the straight part of a leg the drive is on the line
  EXPECT_LT(distance_to(path, {6, 2.5, 1}), 0.003);
  EXPECT_NEAR((path.back().T_world_lidar.translation() - points.back()).norm(), 0, 1e-9);
  EXPECT_NEAR(heading(path.back().T_world_lidar), std::atan2(-4, -5.2), 1e-9);
}

TEST(DriveThrough, TurnsRoundOnTheSpotWhereTheWayGoesBack) {
  const Trajectory path = drive_through({{0, 0, 1}, {5, 0, 1}, {1, 0, 1}}, with_cruise(0.5, 0.8), {});
  EXPECT_LT(motion_of(path).turn_acceleration, 20);
  EXPECT_NEAR(std::abs(heading(path.back().T_world_lidar)), std::numbers::pi, 1e-9);
  EXPECT_NEAR((path.back().T_world_lidar.translation() - Vector3d(1, 0, 1)).norm(), 0, 1e-9);
  for (const StampedPose& pose : path) EXPECT_LT(pose.T_world_lidar.translation().x(), 5);
}

TEST(DriveThrough, TakesSpeedUpAndDownALongAShortWay) {
  const Trajectory path = drive_through({{0, 0, 1}, {0.2, 0, 1}}, with_cruise(2, 0.8), {});
  EXPECT_NEAR(path.back().T_world_lidar.translation().x(), 0.2, 1e-9);
  EXPECT_LT(motion_of(path).fastest, 0.2);
  MotionOptions twice;
  twice.speed_scale = 2;
  EXPECT_NEAR(motion_of(drive_through({{0, 0, 1}, {9, 0, 1}}, with_cruise(0.5, 1), twice)).fastest, 1, 1e-9);
}

TEST(DriveThrough, RefusesSamePointsAndDrivesWithoutEnd) {
  EXPECT_THROW(drive_through({{0, 0, 1}, {0, 0, 1}}, {}, {}), Error);
  EXPECT_THROW(drive_through({{0, 0, 1}, {1e9, 0, 1}}, {}, {}), Error);
}

Trajectory circle(double step) {
  Trajectory poses;
  for (double t = 0; t < 20; t += step) {
    Pose T = upright({4 * std::cos(0.3 * t), 4 * std::sin(0.3 * t), 1}, 0.3 * t);
    T.linear() = T.linear() * Eigen::AngleAxisd(0.2 * std::sin(t), Vector3d::UnitX());
    poses.push_back({100 + t, T});
  }
  return poses;
}

TEST(Follow, PassesEveryPoseAtItsTime) {
  const Trajectory poses = circle(0.5), path = follow(poses, {});
  expect_stamps_at_200_hz(path);
  EXPECT_NEAR(path.back().stamp, poses.back().stamp - 100, 0.006);
  for (const StampedPose& pose : poses) {
    const Pose off = pose.T_world_lidar.inverse() * interpolate(path, pose.stamp - 100);
    EXPECT_LT(off.translation().norm(), 1e-6) << pose.stamp;
    EXPECT_LT(angle_of(off), 1e-6) << pose.stamp;
  }
}

TEST(Follow, HasContinuousVelocityAndTurnRate) {
  const Motion most = motion_of(follow(circle(0.5), {}));  // truly 1.2 m/s, 0.36 m/s^2 and at most 0.36 rad/s
  EXPECT_NEAR(most.fastest, 1.2, 0.02);
  EXPECT_LT(most.acceleration, 0.6);
  EXPECT_LT(most.turn, 0.45);
  EXPECT_LT(most.turn_acceleration, 1);
}

TEST(Follow, ComesCloserToTheTrueMotionWithCloserPoses) {
  const auto worst = [](double step) {
    double off = 0;
    for (const StampedPose& pose : follow(circle(step), {})) {
      const double t = pose.stamp;
      const Vector3d truth(4 * std::cos(0.3 * t), 4 * std::sin(0.3 * t), 1);
      if (t > 2 && t < 17) off = std::max(off, (pose.T_world_lidar.translation() - truth).norm());
    }
    return off;
  };
  EXPECT_LT(worst(1.0), 0.01);
  EXPECT_LT(worst(0.5), worst(1.0) / 6);  // of third order at least
}

TEST(Follow, KeepsARestAtRestAndTwoPosesStraight) {
  const Trajectory path = follow({{0, upright({0, 0, 1}, 0)},
                                  {2, upright({2, 0, 1}, 0)},
                                  {4, upright({2, 0, 1}, 0)},
                                  {6, upright({2, 2, 1}, 1.5)}},
                                 {});
  for (double t = 2; t < 4; t += 0.1) {
    EXPECT_LT((interpolate(path, t).translation() - Vector3d(2, 0, 1)).norm(), 1e-9) << t;
  }
  const Trajectory line = follow({{5, upright({0, 0, 1}, 0)}, {7, upright({4, 0, 1}, 0)}}, {});
  EXPECT_NEAR(interpolate(line, 0.5).translation().x(), 1, 1e-9);
}

TEST(Follow, TurnsTheShorterWayWhateverTheSignOfTheQuaternion) {
  const Trajectory path = follow({{0, upright({0, 0, 1}, 3.0)}, {1, upright({1, 0, 1}, -3.0)}}, {});
  EXPECT_LT(motion_of(path).turn, 0.4);
}

TEST(Follow, RefusesStampsThatDoNotAscendAndTooFewPoses) {
  const Pose T = Pose::Identity();
  EXPECT_THROW(follow({}, {}), Error);
  EXPECT_THROW(follow({{0, T}}, {}), Error);
  EXPECT_THROW(follow({{0, T}, {1, T}, {1, T}}, {}), Error);
  EXPECT_THROW(follow({{0, T}, {1, T}, {0.5, T}}, {}), Error);
  EXPECT_THROW(follow({{0, T}, {1e9, T}}, {}), Error);
}

TEST(Shaken, AddsAsMuchAsAsked) {
  MotionOptions motion;
  motion.vibration = 0.004;
  const Trajectory still = drive_through({{0, 0, 1}, {20, 0, 1}}, with_cruise(1, 1), {});
  const Trajectory shaking = drive_through({{0, 0, 1}, {20, 0, 1}}, with_cruise(1, 1), motion);
  double sum = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    sum += (shaking[i].T_world_lidar.translation() - still[i].T_world_lidar.translation()).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(sum / double(still.size()) / 3), 0.004, 0.0006);
}

}  // namespace
}  // namespace tilth
