// How large vibrations are taken to be: as scans have shown it; and their mean, which is none.
#include "registration/made_vibrations.hpp"
#include <tilth/odometry/vibration_filter.hpp>

namespace tilth {
namespace {

TEST(VibrationFilter, ItsSizeFollowsFromWhatScansShow) {
  VibrationOptions options;
  options.tilt = options.yaw = 5e-3, options.least_rotation = 1e-3, options.first_tilt = 3e-3;
  for (const double rotation : {0.0, 3.5e-3}) {
    std::mt19937 rng(5);
    VibrationFilter filter(options);
    EXPECT_GT(filter.sigma().tilt, 1.5 * options.least_rotation);
    EXPECT_LT(filter.sigma().tilt, options.first_tilt);
    for (std::uint32_t scan = 0; scan < 30; ++scan) {
      const MotionState state = state_at_rest();
      const SegmentSystems parts = linearize(pairs_of(tones(rotation, 0, rng), 0.003, scan), state);
      const VibrationPrior prior = prior_of(filter.sigma(), vibrating());
      const VibrationSystem system = vibration_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanVibration found;
      const VibrationFactor factor = factor_of(system);
      ASSERT_TRUE(step_with_vibration(system, factor, step, found));
      filter.update(2 * kMiddle, found, evidence_of(factor, prior, found));
    }
    const VibrationSigma sigma = filter.sigma();
    EXPECT_NEAR(sigma.tilt, std::max(rotation, options.least_rotation), 6e-4);
    EXPECT_NEAR(sigma.yaw, std::max(rotation, options.least_rotation), 6e-4);
    EXPECT_NEAR(sigma.translation, options.least_translation, 2e-4);
  }
}

TEST(VibrationFilter, WhatStaysAtAnInstantIsTakenBack) {
  const VibrationOptions options;
  const auto left_after_a_minute = [&](bool held) {
    VibrationFilter filter(options);
    std::mt19937 rng(7);
    const MotionState state = state_at_rest();
    for (int scan = 0; scan < 300; ++scan) {
      ScanVibration crooked;  // the part of the map that is seen first is displaced
      crooked.knots[0][5] = 2e-3;
      const SegmentSystems parts = linearize(pairs_of(crooked, 0.003, std::uint32_t(scan % 5)), state);
      const double ratio = mean_gain(0.1);
      const VibrationPrior prior = held ? vibration_prior(kSpread, filter.mean(), {ratio}, options) : prior_of(kSpread);
      const FoundVibration scan_found = found(parts, prior, state);
      filter.update(0.1, scan_found.vibration, {});
    }
    return filter.mean().knots[0][5];
  };
  const double free = left_after_a_minute(false), held = left_after_a_minute(true);
  EXPECT_GT(free, 1e-4);
  EXPECT_LT(std::abs(held), 0.5 * free);
}

// A tenth of the patches that are seen at an instant is renewed with each scan. What is put where the scan seems to
// have been stays where it is; without the mean of the vibrations it comes back.
TEST(VibrationFilter, WithoutItsMeanAMapThatIsAstrayComesBack) {
  const VibrationOptions options;
  constexpr double kAstray = 2e-3, kRatioRenewed = 0.1;  // [m]
  const auto left_after_ten_seconds = [&](bool without_mean) {
    VibrationFilter filter(options);
    ScanVibration map;
    map.knots[0][5] = kAstray;
    const MotionState state = state_at_rest();
    for (int scan = 0; scan < 100; ++scan) {
      const SegmentSystems parts = linearize(pairs_of(map, 0.003, std::uint32_t(scan % 5)), state);
      const double ratio = mean_gain(0.1);
      const VibrationPrior prior = vibration_prior(kSpread, filter.mean(), {ratio}, options);
      const FoundVibration scan_found = found(parts, prior, state);
      filter.update(0.1, scan_found.vibration, {});
      const ScanVibration& whole = scan_found.vibration;
      const double put = (without_mean ? filter.without_mean(whole) : whole).knots[0][5];
      map.knots[0][5] += kRatioRenewed * (scan_found.step[5] - kMiddle * scan_found.step[11] + put - map.knots[0][5]);
    }
    return map.knots[0][5];
  };
  const double kept = left_after_ten_seconds(false), come_back = left_after_ten_seconds(true);
  EXPECT_GT(kept, 0.03 * kAstray);
  EXPECT_LT(std::abs(come_back), 0.6 * kept);
}

TEST(VibrationFilter, ShakesAPlatformAsFarAsItTurnsIt) {
  constexpr double kLong = 1e3;  // [s]: nothing is left of what was believed before
  VibrationOptions options;
  VibrationEvidence evidence;
  evidence.freedom.setConstant(1000);
  evidence.squares = 1000 * Eigen::Vector3d(1e-6, 1e-6, 4e-6);  // 1 mrad, 2 mm
  for (const double lever : {0.0, 0.5, 1.0, 3.0}) {
    options.lever = lever;
    VibrationFilter filter(options);
    filter.update(kLong, {}, evidence);
    const VibrationSigma sigma = filter.sigma();
    EXPECT_NEAR(sigma.translation, std::min(2e-3, options.least_translation + lever * sigma.tilt), 5e-5) << lever;
    EXPECT_NEAR(filter.observed().translation, 2e-3, 5e-5) << "as it is seen, whatever is believed";
  }
}

TEST(VibrationFilter, NoneWhereTheOptionsAllowNone) {
  EXPECT_FALSE(VibrationFilter({}).sigma().none());
  EXPECT_TRUE(VibrationFilter({.tilt = 0}).sigma().none());
  EXPECT_TRUE(VibrationFilter({.least_rotation = 0}).sigma().none());
  EXPECT_TRUE(VibrationFilter({.least_translation = 0}).sigma().none());
}

}  // namespace
}  // namespace tilth
