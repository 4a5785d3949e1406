// Whole drives whose odometry drifts by a known amount: loops that are there must be closed, and none other.
#include <algorithm>
#include <future>

#include <gtest/gtest.h>

#include "slam/made_drives.hpp"
#include <tilth/core/error.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {
namespace {

constexpr double kTurnAround = std::numbers::pi;

struct Outcome {
  Trajectory before, after;
  std::vector<LoopClosure> closures;
  std::vector<Keyframe> keyframes;

  std::size_t count(Verdict verdict) const {
    return std::size_t(
        std::count_if(closures.begin(), closures.end(), [&](const LoopClosure& c) { return c.verdict == verdict; }));
  }
};

/// Every `stride`-th scan of a drive.
Outcome drive_with(const Simulator& simulator, const Drift& drift, std::size_t stride) {
  Slam slam(std::make_unique<DriftingOdometry>(simulator, drift), {});
  for (std::size_t i = 0; i < simulator.size(); i += stride) slam.register_scan(simulator.scan(i).scan);
  slam.finish();
  return {slam.odometry_trajectory(), slam.trajectory(), slam.loops().closures(), slam.loops().keyframes()};
}

/// [m] by which a trajectory's motion from its first pose to its last differs from the true one.
double end_error(const Simulator& simulator, const Trajectory& trajectory) {
  const Pose motion = trajectory.front().T_world_lidar.inverse() * trajectory.back().T_world_lidar;
  const Pose truth = true_motion(simulator, trajectory.front().stamp, trajectory.back().stamp);
  return (motion.translation() - truth.translation()).norm();
}

/// [m] by which an accepted closure differs from the truth, at most.
double worst_closure(const Simulator& simulator, const Outcome& outcome) {
  double worst = 0;
  for (const LoopClosure& c : outcome.closures) {
    if (c.verdict != Verdict::accepted) continue;
    const Pose truth =
        true_motion(simulator, outcome.keyframes[c.constraint.from].stamp, outcome.keyframes[c.constraint.to].stamp);
    worst = std::max(worst, (c.constraint.T_from_to.translation() - truth.translation()).norm());
  }
  return worst;
}

TEST(Slam, FindsItsWayBackInTheOppositeDirection) {
  const std::vector<double> doors{3, 4.7, 9, 13, 14.5, 19, 21, 23.5};
  const std::vector<Leg> there_and_back{{1, 0, 0},           {18, 1.0, 0}, {1, 0, 0},
                                        {4, 0, kTurnAround}, {17, 1.0, 0}, {2, 0, 0}};
  const Simulator simulator = simulated(corridor_scene({26, doors}, there_and_back));
  const Outcome outcome = drive_with(simulator, {.scale = 0.005, .turn = 0.001}, 4);
  EXPECT_GT(end_error(simulator, outcome.before), 0.2);
  EXPECT_GE(outcome.count(Verdict::accepted), 4U);
  EXPECT_LT(worst_closure(simulator, outcome), 0.02);
  EXPECT_LT(end_error(simulator, outcome.after), 0.02);
  EXPECT_EQ(outcome.after.size(), outcome.before.size());
}

TEST(Slam, ClosesNothingOnOneWayThroughIdenticalDoors) {
  std::vector<double> doors;
  for (double at = 2; at < 58; at += 3) doors.push_back(at);
  const std::vector<Leg> one_path{{1, 0, 0}, {37, 1.5, 0}, {1, 0, 0}};
  const Simulator simulator = simulated(corridor_scene({60, doors}, one_path));
  const Outcome outcome = drive_with(simulator, {.scale = -0.01, .turn = 0.0005}, 5);
  EXPECT_GT(outcome.keyframes.size(), 30U);
  EXPECT_EQ(outcome.count(Verdict::accepted), 0U);
  EXPECT_TRUE(std::equal(
      outcome.before.begin(), outcome.before.end(), outcome.after.begin(),
      [](const StampedPose& a, const StampedPose& b) { return a.T_world_lidar.isApprox(b.T_world_lidar, 1e-9); }));
}

// There and back where every door is like the next: odometry that has drifted by half a period may not be brought to
// the wrong door.
TEST(Slam, TakesNoDoorForItsNeighbour) {
  std::vector<double> doors;
  for (double at = 1; at < 38; at += 1.5) doors.push_back(at);
  const std::vector<Leg> there_and_back{{1, 0, 0},           {28, 1.0, 0}, {1, 0, 0},
                                        {4, 0, kTurnAround}, {20, 1.0, 0}, {1, 0, 0}};
  const Simulator simulator = simulated(corridor_scene({40, doors}, there_and_back));
  const Outcome outcome = drive_with(simulator, {.scale = 0.02, .turn = 0.0}, 4);
  EXPECT_LT(worst_closure(simulator, outcome), 0.1);
  EXPECT_LT(end_error(simulator, outcome.after), end_error(simulator, outcome.before) + 0.05);
}

const std::vector<double> kDoors{3, 4.7, 9, 13, 14.5, 19, 21, 23.5};
const std::vector<Leg> kThereAndBack{{1, 0, 0}, {15, 1.5, 0}, {4, 0, kTurnAround}, {11, 1.5, 0}, {1, 0, 0}};

// A thread that closes no loop until the drive is over keeps no scan from its pose, and changes nothing.
TEST(Slam, NoScanWaitsForItsLoops) {
  const Simulator simulator = simulated(corridor_scene({26, kDoors}, kThereAndBack));
  const auto drive_of = [&](bool late) {
    std::promise<void> over;
    Slam slam(std::make_unique<DriftingOdometry>(simulator, Drift{.scale = 0.005, .turn = 0.001}), {});
    if (late) slam.after_keyframe([over = over.get_future().share()](LoopCloser&) { over.wait(); });
    for (std::size_t i = 0; i < simulator.size(); i += 4) slam.register_scan(simulator.scan(i).scan);
    over.set_value();
    slam.finish();
    return slam.trajectory();
  };
  const Trajectory soon = drive_of(false), late = drive_of(true);
  ASSERT_EQ(soon.size(), late.size());
  for (std::size_t i = 0; i < soon.size(); ++i)
    EXPECT_EQ(soon[i].T_world_lidar.matrix(), late[i].T_world_lidar.matrix()) << i;
}

TEST(Slam, TellsHowFarTheNewestPoseHasDrifted) {
  const Simulator simulator = simulated(corridor_scene({26, kDoors}, kThereAndBack));
  Slam slam(std::make_unique<DriftingOdometry>(simulator, Drift{.scale = 0.02, .turn = 0.001}), {});
  EXPECT_TRUE(slam.T_map_odom().isApprox(Pose(Pose::Identity())));
  for (std::size_t i = 0; i < simulator.size(); i += 4) slam.register_scan(simulator.scan(i).scan);
  ASSERT_GT(slam.loops().optimizations(), 0);
  const Trajectory odometry = slam.odometry_trajectory();
  Trajectory known = odometry;
  known.back().T_world_lidar = slam.T_map_odom() * odometry.back().T_world_lidar;
  EXPECT_GT(end_error(simulator, odometry), 0.1);
  EXPECT_LT(end_error(simulator, known), 0.5 * end_error(simulator, odometry)) << "the rest is since the last closure";
}

// What a keyframe throws on the thread reaches who asks for the loops.
TEST(Slam, HandsOnWhatItsThreadThrows) {
  const Simulator simulator = simulated(corridor_scene({12, {3, 7}}, {{3, 1.0, 0}}));
  Slam slam(std::make_unique<DriftingOdometry>(simulator, Drift{}), {});
  slam.after_keyframe([](LoopCloser&) { throw Error("loops", "are knotted"); });
  slam.register_scan(simulator.scan(0).scan);
  EXPECT_THROW(slam.finish(), Error);
}

TEST(Slam, SurvivesScansWithoutPoints) {
  const Simulator simulator = simulated(corridor_scene({12, {3, 7}}, {{3, 1.0, 0}}));
  Slam slam(std::make_unique<DriftingOdometry>(simulator, Drift{}), {});
  for (std::size_t i = 0; i < simulator.size(); i += 10) slam.register_scan({simulator.stamp(i), {}});
  slam.finish();
  EXPECT_FALSE(slam.trajectory().empty());
  EXPECT_TRUE(slam.loops().closures().empty());
}

}  // namespace
}  // namespace tilth
