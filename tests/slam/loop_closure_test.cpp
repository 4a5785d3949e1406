// Verification of a candidate: two submaps of a made corridor, at motions that are known.
#include <gtest/gtest.h>

#include "slam/made_drives.hpp"
#include <tilth/slam/keyframe.hpp>
#include <tilth/slam/loop_closure.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A drive of 28 m through a corridor without ends, and a submap of each of its instants.
class Corridor {
 public:
  explicit Corridor(const std::vector<double>& doors)
      : simulator_(simulated(corridor_scene({60, doors, false}, {{1, 0, 0}, {18, 1.5, 0}, {1, 0, 0}}))) {}

  /// Some scans from scan `begin` on, 0.5 s apart, in the frame of the first.
  Submap submap(std::size_t begin) const {
    DriftingOdometry odometry(simulator_, {});
    SurfacePatches patches;
    for (std::size_t i = 0; i < 4; ++i) {
      const Scan scan = simulator_.scan(begin + 5 * i).scan;
      const OdometryResult result = odometry.register_scan(scan);
      const SurfacePatches more = moved(make_keyframe(result, scan.stamp, {}).patches, result.T_world_lidar);
      patches.insert(patches.end(), more.begin(), more.end());
    }
    return Submap(std::move(patches), VerifyOptions{}.submap);
  }

  Pose motion(std::size_t from, std::size_t to) const {
    constexpr double kMiddle = 0.05;  // [s] of a scan
    return true_motion(simulator_, simulator_.stamp(from) + kMiddle, simulator_.stamp(to) + kMiddle);
  }

 private:
  Simulator simulator_;
};

const std::vector<double> kManyDoors{3, 5.2, 9, 13, 14.7, 19, 23.5, 25, 29, 34, 36.3, 40};

LoopClosure verified(const Corridor& corridor, const Pose& T_guess, double open, FoundBy found_by = FoundBy::radius) {
  const Expectation expected{T_guess, open, 20 * kDegree};
  return verify({0, 1, T_guess, found_by}, corridor.submap(60), corridor.submap(67), expected, {});
}

Pose off(const Pose& T, double along, double across, double yaw) {
  return T * Eigen::Translation3d(along, across, 0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

TEST(VerifyLoop, FindsTheMotionFromARoughGuess) {
  const Corridor corridor(kManyDoors);
  const Pose truth = corridor.motion(60, 67);
  const LoopClosure closure = verified(corridor, off(truth, 0.4, -0.2, 3 * kDegree), 0.6);
  EXPECT_EQ(closure.verdict, Verdict::accepted);
  const Pose error = truth.inverse() * closure.constraint.T_from_to;
  EXPECT_LT(error.translation().norm(), 0.02);
  EXPECT_LT(angle_of(error), 0.1 * kDegree);
  EXPECT_EQ(closure.degenerate_directions, 0);
  EXPECT_GT(closure.overlap, 0.8);
}

// Where the submaps slide along one another, the registration does not come to rest or says nothing of that direction.
TEST(VerifyLoop, DoesNotTellHowFarABareCorridorGoes) {
  const Corridor corridor({});
  const Pose guess = off(corridor.motion(60, 67), 0.3, 0.1, 1 * kDegree);
  const LoopClosure closure = verified(corridor, guess, 1.0);
  const Matrix6d& information = closure.constraint.information;
  EXPECT_TRUE(closure.verdict != Verdict::accepted || information(3, 3) < 0.02 * information(4, 4))
      << information.diagonal().transpose();
  EXPECT_NE(verified(corridor, guess, 1.0, FoundBy::context).verdict, Verdict::accepted);
}

TEST(VerifyLoop, RefusesAPlaceThatIsAnother) {
  const Corridor corridor(kManyDoors);
  const Expectation open{Pose::Identity(), 30, 20 * kDegree};
  const LoopClosure closure =
      verify({0, 1, Pose::Identity(), FoundBy::context}, corridor.submap(20), corridor.submap(110), open, {});
  EXPECT_NE(closure.verdict, Verdict::accepted);
}

TEST(VerifyLoop, RefusesWhatOdometryRulesOut) {
  const Corridor corridor(kManyDoors);
  const Pose truth = corridor.motion(60, 67);
  const Expectation elsewhere{off(truth, 2, 0, 0), 1.0, 20 * kDegree};
  const LoopClosure closure =
      verify({0, 1, truth, FoundBy::radius}, corridor.submap(60), corridor.submap(67), elsewhere, {});
  EXPECT_EQ(closure.verdict, Verdict::against_odometry);
}

TEST(VerifyLoop, DoubtsOneOfManyLikeDoors) {
  std::vector<double> doors;
  for (double at = 1; at < 58; at += 1.5) doors.push_back(at);
  const Corridor corridor(doors);
  const Pose truth = corridor.motion(60, 67);
  const LoopClosure doubted = verified(corridor, truth, 2.5);
  EXPECT_TRUE(doubted.verdict == Verdict::ambiguous || doubted.degenerate_directions > 0) << int(doubted.verdict);
  EXPECT_EQ(verified(corridor, truth, 0.5).verdict, Verdict::accepted);  // odometry rules the next door out
}

TEST(VerifyLoop, SaysThatNothingWasRegisteredWhereThereIsNothing) {
  const Submap nothing({}, VerifyOptions{}.submap);
  const LoopClosure closure = verify({}, nothing, nothing, {}, {});
  EXPECT_EQ(closure.verdict, Verdict::not_registered);
}

}  // namespace
}  // namespace tilth
