// What is known after a scan, for the next one.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/odometry/motion_filter.hpp>

namespace tilth {
namespace {

const Pose kFirst = exp((Vector6d() << 0.02, -0.03, 0.7, 1.0, -0.5, 0.2).finished());
const Vector6d kMotion = (Vector6d() << 0, 0.1, 0.2, 1, 2, 3).finished();
constexpr double kInterval = 0.2;  // [s]

ContinuousTimeAlignment found(const Pose& T_map_lidar, std::size_t matches = 50) {
  ContinuousTimeAlignment alignment;
  alignment.pose.T_target_source = T_map_lidar;
  alignment.pose.matches = matches;
  alignment.motion.velocity = 2 * kMotion;
  return alignment;
}

/// After the first scan at 10 s, and one `kInterval` later that has moved by kMotion.
MotionFilter after_two() {
  MotionFilter filter({});
  filter.update(10, found(kFirst));
  filter.update(10 + kInterval, found(kFirst * exp(kInterval * kMotion)));
  return filter;
}

TEST(MotionFilter, TheFirstScanTellsOfNoMotion) {
  MotionFilter filter({});
  EXPECT_EQ(filter.predict(10).interval, 0.0);
  filter.update(10, found(kFirst));
  const MotionPrior prior = filter.predict(10.5);
  EXPECT_FALSE(prior.known);
  EXPECT_EQ(prior.last_motion, Vector6d::Zero());
  EXPECT_EQ(prior.interval, 0.5);
}

TEST(MotionFilter, RemembersTheMotionSeen) {
  const MotionPrior prior = after_two().predict(10.5);
  EXPECT_TRUE(prior.known);
  EXPECT_NEAR(prior.interval, 0.3, 1e-9);
  EXPECT_TRUE(prior.T_map_last.isApprox(kFirst * exp(kInterval * kMotion)));
  EXPECT_EQ(prior.velocity, 2 * kMotion) << "in the middle of the scan, as it was found";
  EXPECT_LT((prior.last_motion - kMotion).norm(), 1e-9);
  EXPECT_LT((prior.steady_velocity - kMotion).norm(), 1e-9) << "the first motion known";
  EXPECT_EQ(prior.last_change, Vector6d::Zero()) << "one motion tells of no change";
}

TEST(MotionFilter, ForgetsASteadyVelocityWithinSeconds) {
  MotionFilter filter = after_two();
  filter.update(10 + 2 * kInterval, found(kFirst * exp(kInterval * kMotion)));
  const MotionPrior prior = filter.predict(11);
  EXPECT_LT((prior.steady_velocity - std::exp(-kInterval) * kMotion).norm(), 1e-9) << "at rest since";
  EXPECT_LT((prior.last_change + kMotion / kInterval).norm(), 1e-6);
}

TEST(MotionFilter, AScanThatSawNothingTellsOfNoMotion) {
  MotionFilter filter = after_two();
  filter.update(10 + 2 * kInterval, found(kFirst, 0));
  const MotionPrior prior = filter.predict(11);
  EXPECT_TRUE(prior.known);
  EXPECT_LT((prior.last_motion - kMotion).norm(), 1e-9) << "that from before";
  EXPECT_EQ(prior.last_change, Vector6d::Zero());
}

TEST(MotionFilter, AnIntervalOfNothingTellsOfNoChange) {
  MotionFilter filter = after_two();
  filter.update(10 + kInterval, found(kFirst));
  EXPECT_EQ(filter.predict(11).last_change, Vector6d::Zero());
}

TEST(MotionFilter, LooksBackAsWell) {
  const MotionPrior back = after_two().predict(10);
  EXPECT_NEAR(back.interval, -kInterval, 1e-9);
  EXPECT_GT(back.vibration_gain, 0) << "of a scan, whichever way";
}

}  // namespace
}  // namespace tilth
