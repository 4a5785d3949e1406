// Scans that were taken as the sensor sped up or turned in: what is found of their acceleration, and what is believed
// of it before.
#include <gtest/gtest.h>

#include "made_places.hpp"

namespace tilth {
namespace {

const Vector6d kAcceleration = (Vector6d() << 0.1, -0.1, 4.0, 2.0, 0.5, 0.0).finished();

enum class SpeedingUp { since_long, since_last };

/// Of a sensor that moves with kVelocity in the middle of the scan and has sped up since long before the last one, or
/// since the last one only.
MotionPrior sped_up(SpeedingUp since) {
  const bool long_since = since == SpeedingUp::since_long;
  const Pose T_map_last = kTruth * MotionInScan{kVelocity, kAcceleration}.after(-kPeriod);
  const Vector6d motion = log(T_map_last.inverse() * kTruth) / kPeriod;
  return {.T_map_last = T_map_last,
          .velocity = kVelocity - kPeriod * kAcceleration,
          .last_motion = motion - (long_since ? 1.0 : 0.5) * kPeriod * kAcceleration,
          .last_change = long_since ? kAcceleration : Vector6d(Vector6d::Zero()),
          .steady_velocity = motion,
          .interval = kPeriod,
          .known = true};
}

ContinuousTimeAlignment aligned(SpeedingUp since, const ContinuousTimeOptions& options) {
  const SurfacePatches patches = seen(room(), kTruth, MotionInScan{kVelocity, kAcceleration}, 600);
  return align_continuous_time(patches, kMiddle, sped_up(since), room(), options);
}

TEST(AcceleratingScan, IsStraightenedByItsAcceleration) {
  const auto result = aligned(SpeedingUp::since_long, kOptions);
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(pose_error(result), 3e-4);
  EXPECT_LT((result.motion.velocity - kVelocity).norm(), 0.02);
  EXPECT_LT((result.motion.acceleration - kAcceleration).norm(), 0.1 * kAcceleration.norm());
}

TEST(AcceleratingScan, MayBeTheFirstThatIs) {
  const auto result = aligned(SpeedingUp::since_last, kOptions);
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(pose_error(result), 3e-3);
  EXPECT_LT((result.motion.velocity - kVelocity).norm(), 0.3 * kPeriod * kAcceleration.norm());
}

TEST(AcceleratingScan, DiffersFromTheLastOneAsFarAsItMay) {
  const auto error = [&](double slack, double ratio) {
    ContinuousTimeOptions options = kOptions;
    options.velocity_slack = slack;
    options.velocity_ratio = ratio;
    // Half of the acceleration shows in the motion since the last scan.
    return (aligned(SpeedingUp::since_last, options).motion.velocity - kVelocity).norm();
  };
  const double stiff = error(1e-6, 0);
  EXPECT_NEAR(stiff, 0.25 * kPeriod * kAcceleration.norm(), 0.02) << "half of the acceleration is expected";
  EXPECT_LT(error(50, 0), 0.02);
  EXPECT_LT(error(kOptions.velocity_slack, 1), 0.5 * stiff) << "allowed by the change of acceleration seen";
}

TEST(AcceleratingScan, MayBeTakenForOneOfConstantVelocity) {
  ContinuousTimeOptions options = kOptions;
  options.motion_model = MotionModel::constant_velocity;
  const auto straight = aligned(SpeedingUp::since_long, options);
  EXPECT_TRUE(straight.motion.acceleration.isZero(0));
  EXPECT_GT(pose_error(straight), 5 * pose_error(aligned(SpeedingUp::since_long, kOptions)));
}

TEST(AcceleratingScan, IsNotOneThatMovesSteadily) {
  const auto result = align_continuous_time(seen(room(), kTruth, kVelocity, 600), kMiddle,
                                            prior_of(kVelocity, Vector6d::Zero()), room(), kOptions);
  EXPECT_LT(result.motion.acceleration.norm(), 0.05);
}

// The prior alone: where the last two motions lead to, or, before those are known, the motion since the last scan.
TEST(AcceleratingScan, IsExpectedToGoOn) {
  for (const bool known : {true, false}) {
    MotionPrior prior = sped_up(SpeedingUp::since_long);
    prior.known = known;
    MotionState state{kTruth, {kVelocity}, kMiddle};
    ContinuousTimeSystem system;
    system.H.topLeftCorner<6, 6>() = 1e12 * Matrix6d::Identity();  // the pose is certain
    add_velocity_prior(prior, kOptions, state, system);
    const Vector12d step = system.H.ldlt().solve(-system.b);
    const Vector6d expected = known ? kVelocity : Vector6d(log(prior.T_map_last.inverse() * kTruth) / kPeriod);
    EXPECT_LT((kVelocity + step.tail<6>() - expected).norm(), 0.01) << known;
    state.motion.velocity = kVelocity;
    EXPECT_LT((acceleration_in(prior, kOptions, state) - known * kAcceleration).norm(), 0.2) << known;
  }
}

}  // namespace
}  // namespace tilth
