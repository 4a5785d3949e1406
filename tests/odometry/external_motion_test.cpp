// Motions from outside: what is believed of good, biased, delayed and broken ones, and that none of them harms.
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/odometry/external_motion.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr double kScan = 0.1;  // [s]

Vector6d vector6(double rx, double ry, double rz, double tx, double ty, double tz) {
  return (Vector6d() << rx, ry, rz, tx, ty, tz).finished();
}

/// A steady drive; the claim about its next motion, by a source that is `off` in each, after `seconds` of it.
std::optional<MotionClaim> claim_after(double seconds, const Vector6d& off) {
  const Vector6d motion = vector6(0, 0, 0.02, 0.1, 0, 0);
  MotionTrust trust;
  for (double t = 0; t < seconds - 1e-9; t += kScan)
    trust.judge(exp(motion + off), exp(motion), kScan, Matrix6d::Zero());
  return trust.claim(exp(motion + off), kScan, motion / kScan);
}

TEST(MotionTrust, ClaimsNothingBeforeTwoSecondsAndThenWhatTheDeviationsAllow) {
  EXPECT_FALSE(claim_after(1.5, Vector6d::Zero()));
  const std::optional<MotionClaim> good = claim_after(5, Vector6d::Zero());
  ASSERT_TRUE(good);
  EXPECT_LT(std::sqrt(good->variances[3]), 0.015);
  EXPECT_LT(std::sqrt(good->variances[0]), 0.005);
  EXPECT_GE(std::sqrt(good->variances[3]), 2e-3);
  const std::optional<MotionClaim> sideways = claim_after(5, vector6(0, 0, 0, 0, 0.01, 0));
  ASSERT_TRUE(sideways);
  EXPECT_GT(std::sqrt(sideways->variances[4]), 0.018);
  EXPECT_FALSE(claim_after(5, vector6(0, 0, 0, 0, 0.05, 0)));  // the motion expected is surer
}

TEST(MotionTrust, SetsASourceRightThatIsAlwaysTooLong) {
  MotionTrust trust;
  const Vector6d motion = vector6(0, 0, 0.02, 0.1, 0, 0);
  for (int i = 0; i < 200; ++i) trust.judge(exp(1.2 * motion), exp(motion), kScan, Matrix6d::Zero());
  const std::optional<MotionClaim> claim = trust.claim(exp(1.2 * motion), kScan, motion / kScan);
  ASSERT_TRUE(claim);
  EXPECT_NEAR(claim->motion[3], 0.1, 2e-3);
  EXPECT_NEAR(claim->motion[2], 0.02, 2e-3);
  EXPECT_LT(std::sqrt(claim->variances[3]), 0.02);
}

TEST(MotionTrust, RefusesAMotionThatNoRobotMakes) {
  MotionTrust trust;
  for (int i = 0; i < 50; ++i) trust.judge(Pose::Identity(), Pose::Identity(), kScan, Matrix6d::Zero());
  EXPECT_TRUE(trust.claim(exp(vector6(0, 0, 0, 0.1, 0, 0)), kScan, Vector6d::Zero()));
  EXPECT_FALSE(trust.claim(exp(vector6(0, 0, 0, 1, 0, 0)), kScan, Vector6d::Zero()));
  EXPECT_FALSE(trust.claim(exp(vector6(0, 0, 1, 0, 0, 0)), kScan, Vector6d::Zero()));
  EXPECT_FALSE(trust.claim(Pose::Identity(), 0, Vector6d::Zero()));
}

TEST(MotionTrust, WhatAScanCannotTellSpeaksForNoSource) {
  Matrix6d along = Matrix6d::Zero();
  along(3, 3) = 1;
  MotionTrust trust;
  for (int i = 0; i < 50; ++i)
    trust.judge(exp(vector6(0, 0, 0, 0.01, 0.01, 0)), Pose::Identity(), kScan, Matrix6d::Zero());
  const Vector6d before = trust.claim(Pose::Identity(), kScan, Vector6d::Zero())->variances;
  for (int i = 0; i < 50; ++i) trust.judge(Pose::Identity(), Pose::Identity(), kScan, along);
  EXPECT_EQ(trust.claim(Pose::Identity(), kScan, Vector6d::Zero())->variances, before);
  for (int i = 0; i < 50; ++i) trust.judge(exp(vector6(0, 0, 0, 0, 0.015, 0)), Pose::Identity(), kScan, along);
  EXPECT_GT(trust.claim(Pose::Identity(), kScan, Vector6d::Zero())->variances[4], before[4]);
}

TEST(ExternalMotion, LiesBetweenItsPosesAndNowhereElse) {
  const ExternalMotion motion(Trajectory{{1.0, Pose::Identity()},
                                         {1.4, exp(vector6(0, 0, 0, 4, 0, 0))},
                                         {2.2, exp(vector6(0, 0, 0, 5, 0, 0))},
                                         {2.4, exp(vector6(0, 0, 0, 6, 0, 0))}});
  ASSERT_TRUE(motion.between(1.1, 1.3));
  EXPECT_NEAR(motion.between(1.1, 1.3)->translation().x(), 2, 1e-9);
  EXPECT_TRUE(motion.between(1.0, 2.4));
  EXPECT_FALSE(motion.between(0.9, 1.3));
  EXPECT_FALSE(motion.between(1.1, 2.5));
  EXPECT_FALSE(motion.between(1.1, 1.8));  // in a gap
  EXPECT_THROW(ExternalMotion({{1.0, Pose::Identity()}}), Error);
  EXPECT_THROW(ExternalMotion({{1.0, Pose::Identity()}, {1.0, Pose::Identity()}}), Error);
}

/// How a source tells of the true drive.
using Telling = std::function<Trajectory(const Trajectory& truth)>;

Trajectory good(const Trajectory& truth) {
  return truth;
}

Trajectory of_other_scale(const Trajectory& truth) {
  Trajectory told{truth.front()};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Pose moved = truth[i - 1].T_world_lidar.inverse() * truth[i].T_world_lidar;
    told.push_back({truth[i].stamp, retract(told.back().T_world_lidar, 1.2 * log(moved))});
  }
  return told;
}

Trajectory delayed(Trajectory truth) {
  for (StampedPose& pose : truth) pose.stamp += 0.3;
  return truth;
}

Trajectory broken(Trajectory truth) {
  std::mt19937 rng(5);
  std::normal_distribution<double> normal(0, 1);
  for (StampedPose& pose : truth)
    pose.T_world_lidar = retract(pose.T_world_lidar, 0.3 * vector6(normal(rng), normal(rng), normal(rng), normal(rng),
                                                                   normal(rng), normal(rng)));
  return truth;
}

Trajectory stuck(Trajectory truth) {
  for (StampedPose& pose : truth) pose.T_world_lidar = truth.front().T_world_lidar;
  return truth;
}

/// Eighty scans of a corridor, from rest on.
struct Drive {
  Trajectory truth;
  std::vector<Scan> scans;
};

Drive drive_from_rest() {
  const Simulator simulator("corridor", simulation_options("corridor", {{"seed", "7"}, {"columns", "900"}}));
  Drive drive{simulator.truth(), {}};
  for (std::size_t i = 60; i < 140; ++i) drive.scans.push_back(simulator.scan(i).scan);
  return drive;
}

/// [m] worst distance from the truth, the first poses made equal.
double worst_error(const std::string& pipeline, const Drive& drive, const Telling& tell) {
  const auto source = tell ? std::make_shared<ExternalMotion>(tell(drive.truth)) : nullptr;
  const auto odometry = make_odometry(pipeline, {}, source);
  double worst = 0;
  Pose T_truth_world = Pose::Identity();
  for (const Scan& scan : drive.scans) {
    const OdometryResult result = odometry->register_scan(scan);
    const Pose T_truth = interpolate(drive.truth, result.stamp);
    if (&scan == &drive.scans.front()) T_truth_world = T_truth * result.T_world_lidar.inverse();
    worst = std::max(worst, (T_truth.translation() - T_truth_world * result.T_world_lidar.translation()).norm());
  }
  return worst;
}

TEST(ExternalMotion, HarmsNowhereHoweverBad) {
  const Drive drive = drive_from_rest();
  const std::vector<std::pair<std::string, Telling>> all{
      {"good", good}, {"of other scale", of_other_scale}, {"delayed", delayed}, {"broken", broken}, {"stuck", stuck}};
  for (const std::string pipeline : {"tilth", "improved_floam"}) {
    const double without = worst_error(pipeline, drive, {});
    EXPECT_LT(without, 0.02);
    for (const auto& [name, tell] : all)
      EXPECT_LT(worst_error(pipeline, drive, tell), 1.2 * without + 1e-3) << pipeline << ", " << name;
  }
}

TEST(ExternalMotion, IsRefusedByPipelinesThatHaveNoUseForIt) {
  const auto source = std::make_shared<ExternalMotion>(Trajectory{{0, Pose::Identity()}, {1, Pose::Identity()}});
  EXPECT_THROW(make_odometry("floam", {}, source), Error);
}

}  // namespace
}  // namespace tilth
