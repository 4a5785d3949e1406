// What is known after a scan, for the next one.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/registration/motion_prior.hpp>

namespace tilth {
namespace {

const Vector6d kVelocity = (Vector6d() << 0.1, -0.2, 1.0, 1.5, -0.4, 0.1).finished();
const Vector6d kSurprise = (Vector6d() << 0.1, 0.1, -0.3, 0.4, 0.3, -0.2).finished();
const Pose kTruth = exp((Vector6d() << 0.02, -0.03, 0.7, 1.0, -0.5, 0.2).finished());

TEST(MotionPrior, NextRemembersTheMotionSeen) {
  const MotionPrior prior{.T_map_last = kTruth, .velocity = kVelocity, .last_motion = kSurprise, .interval = 0.2};
  const Vector6d motion = (Vector6d() << 0, 0.1, 0.2, 1, 2, 3).finished();
  ContinuousTimeAlignment alignment;
  alignment.motion.velocity = 2 * kVelocity;
  alignment.pose.T_target_source = kTruth * exp(0.2 * motion);
  alignment.pose.matches = 50;
  const MotionPrior after = next(prior, alignment);
  EXPECT_TRUE(after.known);
  EXPECT_EQ(after.interval, 0.0);  // not known yet
  EXPECT_TRUE(after.T_map_last.isApprox(alignment.pose.T_target_source));
  EXPECT_EQ(after.velocity, alignment.motion.velocity);
  EXPECT_LT((after.last_motion - motion).norm(), 1e-9);

  EXPECT_LT((after.steady_velocity - motion).norm(), 1e-9) << "the first motion known";
  MotionPrior later = after;
  later.interval = 0.2;
  EXPECT_LT((next(later, alignment).steady_velocity - std::exp(-0.2) * motion).norm(), 1e-9)
      << "at rest since: the memory of a second fades";

  later.last_motion = motion - 0.2 * kSurprise;
  EXPECT_LT((next(later, alignment).last_change - (Vector6d::Zero() - later.last_motion) / 0.2).norm(), 1e-6)
      << "at rest since";
  EXPECT_EQ(after.last_change, Vector6d::Zero()) << "one motion tells of no change";

  alignment.pose.matches = 0;  // nothing was seen: the motion is that from before
  EXPECT_EQ(next(prior, alignment).last_motion, prior.last_motion);
  EXPECT_FALSE(next(prior, alignment).known);
  EXPECT_TRUE(next(after, alignment).known);
  EXPECT_EQ(next(after, alignment).last_change, Vector6d::Zero()) << "nor does an interval of nothing";

  ContinuousTimeAlignment first;  // the first scan, registered to nothing
  first.pose.matches = 50;
  EXPECT_FALSE(next(MotionPrior(), first).known);
  EXPECT_EQ(next(MotionPrior(), first).last_motion, Vector6d::Zero());
}

}  // namespace
}  // namespace tilth
