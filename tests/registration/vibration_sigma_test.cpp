// How large vibrations are taken to be: their spread as the evidence shows it, and their mean, which is none.
#include "made_vibrations.hpp"

namespace tilth {
namespace {

TEST(Vibration, ItsSizeFollowsFromWhatScansShow) {
  VibrationOptions options;
  options.tilt = options.yaw = 5e-3, options.least_rotation = 1e-3, options.first_tilt = 3e-3;
  for (const double rotation : {0.0, 3.5e-3}) {
    std::mt19937 rng(5);
    VibrationEvidence evidence = first_evidence(options);
    EXPECT_GT(vibration_sigma(evidence, options).tilt, 1.5 * options.least_rotation);
    EXPECT_LT(vibration_sigma(evidence, options).tilt, options.first_tilt);
    for (std::uint32_t scan = 0; scan < 30; ++scan) {
      const MotionState state = state_at_rest();
      const SegmentSystems parts = linearize(pairs_of(tones(rotation, 0, rng), 0.003, scan), state);
      const VibrationPrior prior = prior_of(vibration_sigma(evidence, options), vibrating());
      const VibrationSystem system = vibration_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanVibration found;
      const VibrationFactor factor(system.H);
      ASSERT_TRUE(step_with_vibration(system, factor, step, found));
      const VibrationEvidence fresh = evidence_of(factor, prior, found);
      evidence = faded_sum(evidence, fresh, 2 * kMiddle);
    }
    const VibrationSigma spread = vibration_sigma(evidence, options);
    EXPECT_NEAR(spread.tilt, std::max(rotation, options.least_rotation), 6e-4);
    EXPECT_NEAR(spread.yaw, std::max(rotation, options.least_rotation), 6e-4);
    EXPECT_NEAR(spread.translation, options.least_translation, 2e-4);
  }
}

TEST(Vibration, ThePriorIsThatOfTheKnotsAndOfTheirMean) {
  VibrationOptions options;
  options.mean = 0.4;
  std::mt19937 rng(6);
  const ScanVibration mean = some_vibration(1e-4, 1e-4, rng);
  constexpr double kRatio = 0.05, kScale = 0.1;
  const VibrationPrior prior = vibration_prior(kSpread, mean, {kRatio, kScale}, options);
  const Vector6d s2 = kSpread.variances() / kScale;
  for (std::size_t k = 0; k < mean.knots.size(); ++k) {
    for (int i = 0; i < 6; ++i) {
      const auto cost = [&](double x) {
        const double left = (1 - kRatio) * mean.knots[k][i] + kRatio * x;
        const double mean_variance = options.mean * options.mean * s2[i] * kRatio / 2;
        return 0.5 * x * x / s2[i] + 0.5 * left * left / mean_variance;
      };
      const double best = prior.means.knots[k][i], sigma = std::sqrt(prior.variances[i]);
      EXPECT_NEAR(cost(best + sigma) - cost(best), 0.5, 1e-6);
      EXPECT_NEAR(cost(best - sigma) - cost(best), 0.5, 1e-6);
    }
  }
  EXPECT_TRUE(prior.sigma_variances.isApprox(s2));
}

TEST(Vibration, WhatStaysAtAnInstantIsTakenBack) {
  const VibrationOptions options;
  const auto left_after_a_minute = [&](bool held) {
    ScanVibration mean;
    std::mt19937 rng(7);
    const MotionState state = state_at_rest();
    for (int scan = 0; scan < 300; ++scan) {
      ScanVibration crooked;  // the part of the map that is seen first is displaced
      crooked.knots[0][5] = 2e-3;
      const SegmentSystems parts = linearize(pairs_of(crooked, 0.003, std::uint32_t(scan % 5)), state);
      const double ratio = mean_gain(0.1);
      const VibrationPrior prior = held ? vibration_prior(kSpread, mean, {ratio}, options) : prior_of(kSpread);
      const FoundVibration scan_found = found(parts, prior, state);
      mean = mean_with(mean, scan_found.vibration, ratio);
    }
    return mean.knots[0][5];
  };
  const double free = left_after_a_minute(false), held = left_after_a_minute(true);
  EXPECT_GT(free, 1e-4);
  EXPECT_LT(std::abs(held), 0.5 * free);
}

// A tenth of the patches that are seen at an instant is renewed with each scan. What is put where the scan seems to
// have been stays where it is; without the mean of the vibrations it comes back.
TEST(Vibration, WithoutItsMeanAMapThatIsAstrayComesBack) {
  const VibrationOptions options;
  constexpr double kAstray = 2e-3, kRatioRenewed = 0.1;  // [m]
  const auto left_after_ten_seconds = [&](bool without_mean) {
    ScanVibration mean, map;
    map.knots[0][5] = kAstray;
    const MotionState state = state_at_rest();
    for (int scan = 0; scan < 100; ++scan) {
      const SegmentSystems parts = linearize(pairs_of(map, 0.003, std::uint32_t(scan % 5)), state);
      const double ratio = mean_gain(0.1);
      const VibrationPrior prior = vibration_prior(kSpread, mean, {ratio}, options);
      const FoundVibration scan_found = found(parts, prior, state);
      mean = mean_with(mean, scan_found.vibration, ratio);
      const double put = (without_mean ? without(scan_found.vibration, mean) : scan_found.vibration).knots[0][5];
      map.knots[0][5] += kRatioRenewed * (scan_found.step[5] - kMiddle * scan_found.step[11] + put - map.knots[0][5]);
    }
    return map.knots[0][5];
  };
  const double kept = left_after_ten_seconds(false), come_back = left_after_ten_seconds(true);
  EXPECT_GT(kept, 0.03 * kAstray);
  EXPECT_LT(std::abs(come_back), 0.6 * kept);
}

TEST(Vibration, ShakesAPlatformAsFarAsItTurnsIt) {
  VibrationOptions options;
  VibrationEvidence evidence;
  evidence.freedom.setConstant(1000);
  evidence.squares = 1000 * Eigen::Vector3d(1e-6, 1e-6, 4e-6);  // 1 mrad, 2 mm
  for (const double lever : {0.0, 0.5, 1.0, 3.0}) {
    options.lever = lever;
    const VibrationSigma spread = vibration_sigma(evidence, options);
    EXPECT_NEAR(spread.translation, std::min(2e-3, options.least_translation + lever * spread.tilt), 5e-5) << lever;
  }
  EXPECT_NEAR(observed_sigma(evidence, options).translation, 2e-3, 5e-5);  // as it is seen, whatever is believed
}

TEST(Vibration, NoneWhereTheOptionsAllowNone) {
  VibrationOptions options;
  EXPECT_FALSE(vibration_sigma({}, options).none());
  options.tilt = 0;
  EXPECT_TRUE(vibration_sigma({}, options).none());
  options = {.least_rotation = 0};
  EXPECT_TRUE(vibration_sigma({}, options).none());
}

}  // namespace
}  // namespace tilth
