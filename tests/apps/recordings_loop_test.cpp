// Loop closure on a real recording: a vehicle that comes back over its own way in the opposite direction. Skipped where
// it is not at hand.
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "support/real_recording.hpp"
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/slam/slam.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Found by ICP between raw scans, to 0.1 m and 0.5 degrees of yaw; the vehicle's tilt was not asked for.
struct Meeting {
  std::size_t later, earlier;
  Eigen::Vector3d place;  // [m] of the later scan in the earlier one
  double yaw;             // [deg]
};

const Meeting kMeetings[] = {{405, 74, {0.16, -0.80, -0.09}, 180.0},
                             {395, 77, {0.05, -0.79, -0.04}, -179.6},
                             {385, 83, {0.02, -0.75, -0.02}, -178.1},
                             {370, 98, {-0.25, 0.00, 0.00}, -162.6}};

std::unique_ptr<Slam> driven(const std::filesystem::path& folder, const std::string& pipeline,
                             const OptionValues& values) {
  const auto source = open_source(folder.string(), {});
  auto slam = std::make_unique<Slam>(make_odometry(pipeline, values), SlamOptions{});
  while (const auto scan = source->next()) slam->register_scan(*scan);
  slam->finish();
  return slam;
}

// Raw scans carry the skew of their motion: of two vehicles' meeting head on at 5 m/s, 0.1 of a scan is 0.1 m. What ICP
// makes of them belongs to the ends of these scans better than to their middles, so this is where poses are asked for.
TEST(LoopClosureOnRecordings, VehicleComesBackTheOtherWay) {
  const auto folder = recording("vlp16-outdoor-loop");
  NEEDS(folder);
  const std::unique_ptr<Slam> driven_slam = driven(folder, "tilth", {{"pose_at", "1"}});
  const Slam& slam = *driven_slam;
  const Trajectory trajectory = slam.trajectory();
  ASSERT_EQ(trajectory.size(), 406U);
  for (const Meeting& meeting : kMeetings) {
    const Pose T = trajectory[meeting.earlier].T_world_lidar.inverse() * trajectory[meeting.later].T_world_lidar;
    EXPECT_LT((T.translation() - meeting.place).norm(), 0.15) << meeting.later;
    const double yaw = std::atan2(T.linear()(1, 0), T.linear()(0, 0)) - meeting.yaw * kDegree;
    EXPECT_LT(std::abs(std::remainder(yaw, 2 * std::numbers::pi)), 0.7 * kDegree) << meeting.later;
  }
  // None that is false: the vehicle meets its first way from scan 341 on, and nowhere else.
  std::size_t accepted = 0;
  for (const LoopClosure& closure : slam.loops().closures()) {
    if (closure.verdict != Verdict::accepted) continue;
    ++accepted;
    const Keyframe& from = slam.loops().keyframes()[closure.constraint.from];
    const Keyframe& to = slam.loops().keyframes()[closure.constraint.to];
    EXPECT_GE(to.scan, 330U);
    EXPECT_TRUE(from.scan >= 60 && from.scan <= 140) << from.scan;
    const Pose T = trajectory[from.scan].T_world_lidar.inverse() * trajectory[to.scan].T_world_lidar;
    EXPECT_LT((T.translation() - closure.constraint.T_from_to.translation()).norm(), 0.05);
  }
  EXPECT_GE(accepted, 10U);
}

// Straightened by their own motion, and submaps rather than single scans, the same places say how good odometry is
// alone: closures do not depend on it once they are found.
TEST(LoopClosureOnRecordings, OdometryAloneMeetsWhatStraightenedScansSay) {
  const auto folder = recording("vlp16-outdoor-loop");
  NEEDS(folder);
  const std::unique_ptr<Slam> slam = driven(folder, "tilth", {});
  const Trajectory& odometry = slam->odometry_trajectory();
  std::size_t accepted = 0;
  for (const LoopClosure& closure : slam->loops().closures()) {
    if (closure.verdict != Verdict::accepted) continue;
    ++accepted;
    const std::size_t from = slam->loops().keyframes()[closure.constraint.from].scan;
    const std::size_t to = slam->loops().keyframes()[closure.constraint.to].scan;
    const Pose T_from_to = odometry[from].T_world_lidar.inverse() * odometry[to].T_world_lidar;
    const Pose error = closure.constraint.T_from_to.inverse() * T_from_to;
    EXPECT_LT(error.translation().norm(), 0.1) << to << " in " << from;
    EXPECT_LT(angle_of(error), 0.3 * kDegree) << to << " in " << from;
  }
  EXPECT_GE(accepted, 10U);
}

}  // namespace
}  // namespace tilth
