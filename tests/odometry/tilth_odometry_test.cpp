// The pipeline `tilth` on simulated recordings with known truth, whole and broken.
#include <functional>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

/// What becomes of scan `i` of a drive: the scan to give, or nothing.
using Accident = std::function<std::optional<Scan>(const Simulator& simulator, std::size_t i, Scan scan)>;

struct Drive {
  std::string scene;
  std::size_t first, scans;
  Accident accident = {};
  std::size_t judged_from = 0;  ///< scans before are not judged
};

struct Outcome {
  double worst = 0;       ///< [m] from the truth, the first poses made equal
  double worst_turn = 0;  ///< [rad]
  std::vector<Pose> poses;
};

Outcome drive(const Drive& drive) {
  const Simulator simulator(drive.scene, simulation_options(drive.scene, {{"seed", "7"}}));
  const auto odometry = make_odometry("tilth", {});
  Outcome outcome;
  Pose T_truth_world = Pose::Identity();
  for (std::size_t i = 0; i < drive.scans; ++i) {
    std::optional<Scan> scan = simulator.scan(drive.first + i).scan;
    if (drive.accident) scan = drive.accident(simulator, i, *scan);
    if (!scan) continue;
    const OdometryResult result = odometry->register_scan(*scan);
    outcome.poses.push_back(result.T_world_lidar);
    const Pose T_truth = interpolate(simulator.truth(), result.stamp);
    if (i == 0) T_truth_world = T_truth * result.T_world_lidar.inverse();
    if (i < drive.judged_from) continue;
    const Pose error = T_truth.inverse() * T_truth_world * result.T_world_lidar;
    outcome.worst = std::max(outcome.worst, error.translation().norm());
    outcome.worst_turn = std::max(outcome.worst_turn, angle_of(error));
  }
  return outcome;
}

TEST(TilthOdometry, FollowsTheCorridorFromRest) {
  const Outcome outcome = drive({"corridor", 85, 60});
  EXPECT_LT(outcome.worst, 0.02);
  EXPECT_LT(outcome.worst_turn, 0.005);
  EXPECT_GT(outcome.poses.back().translation().norm(), 1.0);
}

TEST(TilthOdometry, FollowsADriveOfTwoMetresASecond) {
  const Outcome outcome = drive({"plaza_fast", 100, 45});
  EXPECT_LT(outcome.worst, 0.05);
  EXPECT_LT(outcome.worst_turn, 0.01);
}

// [rad] about the vertical, by scans `first` to `last` of a drive that begins ten scans before.
double heading_gained(const Simulator& simulator, std::size_t first, std::size_t last) {
  constexpr std::size_t kScans = 10;  // before and after, on average
  const auto odometry = make_odometry("tilth", {});
  double gained = 0;
  for (std::size_t i = first - kScans; i < last + kScans; ++i) {
    const OdometryResult result = odometry->register_scan(simulator.scan(i).scan);
    const Pose error = result.T_world_lidar * interpolate(simulator.truth(), result.stamp).inverse();
    const double heading = std::atan2(error(1, 0), error(0, 0));
    if (i < first) gained -= heading / kScans;
    if (i >= last) gained += heading / kScans;
  }
  return gained;
}

// Two turns of 90 degrees in a second and a half, at 1.9 m/s: a constant velocity in each scan gains a milliradian in
// each.
TEST(TilthOdometry, GainsNoHeadingInSharpTurns) {
  const Simulator simulator("office", simulation_options("office", {{"seed", "7"}, {"speed", "2.5"}}));
  EXPECT_LT(std::abs(heading_gained(simulator, 150, 270)), 6e-4);
}

// Maps are made of scans that are straightened by it, on platforms that shake as well.
TEST(TilthOdometry, TellsHowAScanWasBent) {
  const Simulator simulator("corridor_rough", simulation_options("corridor_rough", {{"seed", "7"}}));
  const auto odometry = make_odometry("tilth", {});
  double bent = 0, straight = 0;  // [m] summed over points
  for (std::size_t i = 130; i < 160; ++i) {
    const Scan scan = simulator.scan(i).scan;
    const OdometryResult result = odometry->register_scan(scan);
    if (i < 145) continue;
    const double pose_time = result.stamp - scan.stamp;
    const PointCloud by_motion = deskew(result.filtered, result.motion, pose_time);
    const PointCloud by_velocity = deskew(result.filtered, {result.motion.velocity}, pose_time);
    const Pose T_lidar_world = interpolate(simulator.truth(), result.stamp).inverse();
    for (std::size_t k = 0; k < result.filtered.size(); k += 50) {
      const Pose T_world_then = interpolate(simulator.truth(), scan.stamp + double(result.filtered.times[k]));
      const Eigen::Vector3d truth = T_lidar_world * T_world_then * result.filtered.points[k];
      bent += (by_motion.points[k] - truth).norm();
      straight += (by_velocity.points[k] - truth).norm();
    }
  }
  EXPECT_LT(bent, 0.75 * straight) << "half as far off";
}

TEST(TilthOdometry, TheFirstPoseIsExactAndNoOtherIs) {
  const Simulator simulator("corridor", simulation_options("corridor", {{"seed", "7"}}));
  const auto odometry = make_odometry("tilth", {});
  const Matrix6d first = odometry->register_scan(simulator.scan(100).scan).covariance.value();
  EXPECT_TRUE(first.isZero(0)) << "in its own frame";
  for (std::size_t i = 101; i < 104; ++i) {
    const Matrix6d later = odometry->register_scan(simulator.scan(i).scan).covariance.value();
    EXPECT_GT(later.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0) << i;
    EXPECT_GT(later.diagonal().head<2>().minCoeff(), 1e-8) << "by the vibration of the first scan, at least";
  }
}

// [rad] of the turn that the last second of six has on average in the frame of the first pose, which then shook.
double lasting_turn(const Simulator& simulator, const std::string& reanchor_after, std::size_t first) {
  const auto odometry = make_odometry("tilth", {{"reanchor_after", reanchor_after}});
  Pose T_truth_world;
  Eigen::Vector3d turns = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 60; ++i) {
    const OdometryResult result = odometry->register_scan(simulator.scan(first + i).scan);
    const Pose T_truth = interpolate(simulator.truth(), result.stamp);
    if (i == 0) T_truth_world = T_truth * result.T_world_lidar.inverse();
    if (i >= 50) turns += log(T_truth_world * result.T_world_lidar * T_truth.inverse()).head<3>();
  }
  return turns.norm() / 10;
}

TEST(TilthOdometry, TheWorldIsReanchoredWhereTheFirstScanIs) {
  double settled = 0, unanchored = 0;
  for (const std::string seed : {"8", "12"}) {
    const Simulator simulator("corridor_rough", simulation_options("corridor_rough", {{"seed", seed}}));
    for (const std::size_t first : {55, 140}) {
      settled += lasting_turn(simulator, "4", first);
      unanchored += lasting_turn(simulator, "1e6", first);
    }
  }
  EXPECT_GT(unanchored, 0.02) << "or else the platform does not shake";
  EXPECT_LT(settled, 0.5 * unanchored);
}

TEST(TilthOdometry, BeginsInTheMiddleOfADrive) {
  EXPECT_LT(drive({"corridor", 150, 30}).worst, 0.03);
}

TEST(TilthOdometry, GivesTheSameBitsWhateverTheNumberOfThreads) {
  const auto poses_with = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return drive({"corridor", 120, 20}).poses;
  };
  const std::vector<Pose> one = poses_with(1), four = poses_with(4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].matrix(), four[i].matrix()) << i;
}

TEST(TilthOdometry, SurvivesScansFromSomewhereElse) {
  const auto elsewhere = [](const Simulator& simulator, std::size_t i, Scan scan) {
    if (i >= 30 && i < 35) scan.cloud = simulator.scan(simulator.size() - 200).scan.cloud;
    return std::optional(scan);
  };
  EXPECT_LT(drive({"corridor", 100, 50, elsewhere, 38}).worst, 0.02);
}

TEST(TilthOdometry, SurvivesAScanShiftedAway) {
  const auto shifted = [](const Simulator&, std::size_t i, Scan scan) {
    for (Eigen::Vector3d& p : scan.cloud.points) p.x() += i == 30 ? 100 : 0;
    return std::optional(scan);
  };
  EXPECT_LT(drive({"corridor", 100, 50, shifted, 33}).worst, 0.02);
}

TEST(TilthOdometry, SurvivesAScanOfNoise) {
  const auto noisy = [](const Simulator&, std::size_t i, Scan scan) {
    std::mt19937 rng(3);
    std::uniform_real_distribution<double> ratio(0.02, 1.0);
    for (Eigen::Vector3d& p : scan.cloud.points) p *= i == 30 ? ratio(rng) : 1.0;
    return std::optional(scan);
  };
  EXPECT_LT(drive({"corridor", 100, 50, noisy, 33}).worst, 0.02);
}

TEST(TilthOdometry, SurvivesEmptyScans) {
  const auto emptied = [](const Simulator&, std::size_t i, Scan scan) {
    if (i >= 30 && i < 33) scan.cloud = {};
    return std::optional(scan);
  };
  EXPECT_LT(drive({"corridor", 100, 50, emptied, 35}).worst, 0.02);
}

TEST(TilthOdometry, SurvivesAStampThatStandsStill) {
  const auto repeated = [](const Simulator& simulator, std::size_t i, Scan scan) {
    return std::optional(i == 30 ? simulator.scan(129).scan : scan);
  };
  EXPECT_LT(drive({"corridor", 100, 50, repeated, 31}).worst, 0.02);
}

TEST(TilthOdometry, SurvivesTheLossOfEveryThirdScan) {
  const auto lost = [](const Simulator&, std::size_t i, Scan scan) {
    return i % 3 == 2 ? std::nullopt : std::optional(scan);
  };
  EXPECT_LT(drive({"corridor", 85, 60, lost}).worst, 0.02);
  EXPECT_LT(drive({"plaza_fast", 100, 45, lost}).worst, 0.08);
}

}  // namespace
}  // namespace tilth
