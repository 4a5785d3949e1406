// Every scene: a drive clear of its walls, scans that return, motion within what a platform can do.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class Scenes : public testing::TestWithParam<std::string_view> {
 protected:
  Simulator simulator(OptionValues values = {}) const {
    values.try_emplace("columns", "200");
    return Simulator(GetParam(), simulation_options(GetParam(), values));
  }
};

/// Rays all round from `origin`, level and slanted.
std::vector<Ray> rays_round(const Eigen::Vector3d& origin) {
  std::vector<Ray> rays;
  for (int i = 0; i < 72; ++i) {
    for (const double slope : {-0.8, -0.3, 0.0, 0.3}) {
      rays.push_back(
          {origin, Eigen::Vector3d(std::cos(i * 5 * kDegree), std::sin(i * 5 * kDegree), slope).normalized(), 0});
    }
  }
  return rays;
}

TEST_P(Scenes, KeepTheSensorClearOfStaticSurfaces) {
  const Simulator made = simulator();
  const MeshWorld still(made.world().mesh(), {});
  for (std::size_t i = 0; i < made.truth().size(); i += 50) {
    for (const Hit& hit : still.cast(rays_round(made.truth()[i].T_world_lidar.translation()))) {
      ASSERT_GT(hit.distance, 0.3) << "at " << made.truth()[i].stamp << " s";
    }
  }
}

/// No wall turns its back: what a ray meets was meant to be seen from there, so it lies within the scene's ground.
TEST_P(Scenes, ReturnMostOfTheirBeams) {
  const Simulator made = simulator();
  const bool open = GetParam().starts_with("plaza") || GetParam() == "street" || GetParam() == "city";
  for (std::size_t k = 0; k < made.size(); k += 50) {
    const double ratio = double(made.scan(k).labels.size()) / double(made.lidar().rings() * made.lidar().columns);
    EXPECT_GT(ratio, open ? 0.45 : 0.9) << "scan " << k;
  }
}

TEST_P(Scenes, KeepRollAndPitchWithinTwoDegrees) {
  const Trajectory truth = simulator({{"vibration", "0"}, {"vibration_angle", "0"}}).truth();
  for (const StampedPose& pose : truth) {
    const double tilt = std::acos(std::min(1.0, pose.T_world_lidar.linear()(2, 2)));
    ASSERT_LT(tilt, 2 * kDegree) << pose.stamp;
  }
}

TEST_P(Scenes, MoveWithoutJumps) {
  const Trajectory truth = simulator({{"vibration", "0"}, {"vibration_angle", "0"}}).truth();
  const double fastest = GetParam() == "street" ? 8.6 : GetParam() == "city" ? 9.1 : 2.7;  // [m/s]
  const double strongest = GetParam() == "street" ? 12.0 : 6.5;                            // [m/s^2]
  for (std::size_t i = 2; i < truth.size(); ++i) {
    const Eigen::Vector3d v0 =
        (truth[i - 1].T_world_lidar.translation() - truth[i - 2].T_world_lidar.translation()) * 200;
    const Eigen::Vector3d v1 = (truth[i].T_world_lidar.translation() - truth[i - 1].T_world_lidar.translation()) * 200;
    ASSERT_LT(v1.norm(), fastest) << truth[i].stamp;
    ASSERT_LT((v1 - v0).norm() * 200, strongest) << truth[i].stamp;
  }
}

TEST_P(Scenes, KeepPeopleClearOfTheSensor) {
  const Simulator made = simulator();
  for (const Walker& walker : made.world().movers().walkers) {
    for (std::size_t i = 0; i < made.truth().size(); i += 20) {
      const StampedPose& pose = made.truth()[i];
      const Eigen::Vector3d apart = pose_at(walker, pose.stamp).translation() - pose.T_world_lidar.translation();
      ASSERT_GE(apart.head<2>().norm(), 0.6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(scene_names().begin(), scene_names().end()),
                         [](const auto& scene) { return std::string(scene.param); });

double speed_at(const Trajectory& truth, double time) {
  const Eigen::Vector3d a = interpolate(truth, time - 0.05).translation(),
                        b = interpolate(truth, time + 0.05).translation();
  return (b - a).norm() / 0.1;
}

double yaw_at(const Trajectory& truth, double time) {
  const Eigen::Vector3d heading = interpolate(truth, time).linear().col(0);
  return std::atan2(heading.y(), heading.x());
}

TEST(Corridor, IsDrivenAsInThePaper) {
  const Trajectory truth = Simulator("corridor", simulation_options("corridor", {})).truth();
  EXPECT_NEAR(truth.back().stamp, 100, 0.1);
  EXPECT_NEAR((truth[1800].T_world_lidar.translation() - truth[0].T_world_lidar.translation()).norm(), 0, 1e-9);
  double fastest = 0;
  for (double t = 12.5; t < 46; t += 0.5) {
    EXPECT_GT(speed_at(truth, t), 0.39) << t;
    EXPECT_LT(speed_at(truth, t), 0.61) << t;
  }
  for (double t = 50; t < 80; t += 0.5) fastest = std::max(fastest, speed_at(truth, t));
  EXPECT_NEAR(fastest, 1.0, 0.05);
  EXPECT_NEAR(yaw_at(truth, 45), 0, 3 * kDegree);
  EXPECT_NEAR(yaw_at(truth, 50), -45 * kDegree, 5 * kDegree);
  EXPECT_NEAR(yaw_at(truth, 55), -90 * kDegree, 3 * kDegree);
  EXPECT_NEAR(yaw_at(truth, 80), -135 * kDegree, 5 * kDegree);
  EXPECT_NEAR(std::abs(yaw_at(truth, 90)), 180 * kDegree, 3 * kDegree);
  EXPECT_NEAR(speed_at(truth, 99.9), 0, 0.01);
  EXPECT_NEAR(path_length(truth), 46, 2);
}

TEST(Corridor, IsABareTunnelWhereAsked) {
  const Simulator bare("corridor", simulation_options("corridor", {{"bare", "1000"}})),
      full("corridor", simulation_options("corridor", {{"bare", "0"}}));
  EXPECT_LT(bare.world().mesh().triangles.size(), 60u);
  EXPECT_GT(full.world().mesh().triangles.size(), 200u);
}

TEST(Plaza, StopsReversesAndTurnsSharply) {
  const Trajectory truth = Simulator("plaza", simulation_options("plaza", {})).truth();
  double backward = 0, spin = 0, still = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Pose step = truth[i - 1].T_world_lidar.inverse() * truth[i].T_world_lidar;
    backward = std::min(backward, step.translation().x() * 200);
    spin = std::max(spin, angle_of(step) * 200);
    if (step.translation().norm() * 200 < 0.01 && truth[i].stamp > 10) still += 1.0 / 200;
  }
  EXPECT_LT(backward, -0.4);
  EXPECT_GT(spin, 50 * kDegree);
  EXPECT_GT(still, 5);
}

TEST(Office, ComesBackToItsStart) {
  const Trajectory truth = Simulator("office", simulation_options("office", {})).truth();
  double nearest = 100;
  for (const StampedPose& pose : truth) {
    if (pose.stamp > 60)
      nearest = std::min(nearest, (pose.T_world_lidar.translation() - truth[0].T_world_lidar.translation()).norm());
  }
  EXPECT_LT(nearest, 0.4);
  EXPECT_GT(path_length(truth), 70);
}

/// [m] of the drive that lie within 2 m of where it was half a minute or more before, driven in the same `direction`
/// (1) or in the other one (-1).
double driven_again(const Trajectory& truth, double direction) {
  double length = 0;
  for (std::size_t i = 200; i < truth.size(); i += 50) {
    const Pose& T = truth[i].T_world_lidar;
    bool again = false;
    for (std::size_t k = 0; k + 6000 < i && !again; k += 20) {
      const Pose& earlier = truth[k].T_world_lidar;
      again = (earlier.translation() - T.translation()).norm() < 2 &&
              direction * earlier.linear().col(0).dot(T.linear().col(0)) > 0.9;
    }
    if (again) length += (T.translation() - truth[i - 50].T_world_lidar.translation()).norm();
  }
  return length;
}

TEST(City, IsDrivenInLoopsBothWaysAndEndsWhereItBegan) {
  const Trajectory truth = Simulator("city", simulation_options("city", {})).truth();
  const Pose moved = truth.front().T_world_lidar.inverse() * truth.back().T_world_lidar;
  EXPECT_LT(moved.translation().norm(), 1.5);
  EXPECT_LT(angle_of(moved), 3 * kDegree);
  EXPECT_NEAR(path_length(truth), 2577, 5);
  EXPECT_GT(driven_again(truth, 1), 80);
  EXPECT_GT(driven_again(truth, -1), 450);
}

TEST(City, IsDrivenMoreSlowlyRoundItsCorners) {
  const Trajectory truth = Simulator("city", simulation_options("city", {})).truth();
  EXPECT_NEAR(speed_at(truth, 12), 9, 0.1);
  for (std::size_t i = 200; i + 200 < truth.size(); i += 20) {
    const double stamp = truth[i].stamp;
    const double turn = angle_of(interpolate(truth, stamp - 0.05).inverse() * interpolate(truth, stamp + 0.05)) / 0.1;
    if (turn > 25 * kDegree) {
      ASSERT_NEAR(speed_at(truth, stamp), 4.5, 0.2) << stamp;
    }
  }
}

TEST(City, HasPlacesInBoundedMemory) {
  const Simulator made("city", simulation_options("city", {{"duration", "1"}}));
  EXPECT_EQ(made.lidar().name, "vlp16");
  EXPECT_EQ(made.world().movers().walkers.size(), 5u);
  const std::vector<Surface>& surfaces = made.world().mesh().surfaces;
  for (const auto& [name, least] : {std::pair{"facade", 150}, {"trunk", 100}, {"pole", 60}, {"car body", 150}}) {
    EXPECT_GT(std::count_if(surfaces.begin(), surfaces.end(), [&](const Surface& s) { return s.name == name; }), least)
        << name;
  }
  EXPECT_LT(made.world().mesh().triangles.size(), 300'000u);
}

}  // namespace
}  // namespace tilth
