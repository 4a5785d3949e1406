// The tremor of a scan: its system against a quadratic cost written out, and its size as the evidence shows it.
#include <numbers>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <tilth/registration/tremor.hpp>

namespace tilth {
namespace {

constexpr double kMiddle = 0.05;  // [s]
constexpr int kKnots = ScanTremor::kIntervals + 1;
const TremorSpread kSpread{2e-3, 1.5e-3, 1e-3};

/// Of knots that tell nothing about each other.
const KnotMatrix kApart = KnotMatrix::Identity();

/// Of vibrations.
KnotMatrix vibrating() {
  return knot_precision(2 * kMiddle, TremorOptions());
}

/// Nothing known but the spread.
TremorPrior prior_of(const TremorSpread& spread, const KnotMatrix& precision = kApart) {
  return tremor_prior(spread, {}, {.precision = precision}, TremorOptions());
}

/// Pairs of flat patches all around, whose residuals are those of a LiDAR that deviates by `tremor`, and of noise [m].
PatchPairs pairs_of(const ScanTremor& tremor, double noise, std::uint32_t seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::normal_distribution<double> error(0, noise);
  PatchPairs pairs;
  for (int i = 0; i < 3000; ++i) {
    const double x = u(rng), y = u(rng), z = u(rng), a = u(rng), b = u(rng), c = u(rng), lever = kMiddle * u(rng);
    const Eigen::Vector3d point = 8 * Eigen::Vector3d(x, y, z), normal = Eigen::Vector3d(a, b, c).normalized();
    const Vector6d moved = tremor.at(0.5 + 0.5 * lever / kMiddle);
    const Eigen::Vector3d shift = moved.head<3>().cross(point) + moved.tail<3>();
    pairs.flat.push_back({point, normal, error(rng) - normal.dot(shift), 1e5, lever});
  }
  return pairs;
}

ScanTremor some_tremor(double rotation, double translation, std::mt19937& rng) {
  std::normal_distribution<double> n(0, 1);
  ScanTremor tremor;
  for (Vector6d& knot : tremor.knots) {
    for (int i = 0; i < 6; ++i) knot[i] = (i < 3 ? rotation : translation) * n(rng);
  }
  return tremor;
}

/// Tones of 6 to 24 Hz.
ScanTremor vibration(double rotation, double translation, std::mt19937& rng) {
  constexpr int kTones = 12;
  std::uniform_real_distribution<double> frequency(6, 24), phase(0, 2 * std::numbers::pi);
  ScanTremor tremor;
  for (int i = 0; i < 6; ++i) {
    for (int tone = 0; tone < kTones; ++tone) {
      const double turns = frequency(rng), from = phase(rng);
      for (int k = 0; k < kKnots; ++k) {
        const double time = 2 * kMiddle * k / ScanTremor::kIntervals;
        tremor.knots[std::size_t(k)][i] += (i < 3 ? rotation : translation) * std::sqrt(2.0 / kTones) *
                                           std::sin(2 * std::numbers::pi * turns * time + from);
      }
    }
  }
  return tremor;
}

MotionState state_at_rest() {
  MotionState state;
  state.middle = kMiddle;
  state.kernel_width = 1e6;
  return state;
}

MovingSystem with_weak_prior(MovingSystem system) {
  system.H.diagonal().array() += 1e5;
  return system;
}

TEST(Tremor, TheSystemIsThatOfTheQuadraticCost) {
  std::mt19937 rng(1);
  const PatchPairs pairs = pairs_of(some_tremor(3e-3, 3e-3, rng), 0.01, 2);
  const MovingParts parts = linearize(pairs, state_at_rest());
  const TremblingSystem system =
      trembling_system(parts, with_weak_prior(sum_of(parts)), prior_of(kSpread, vibrating()), state_at_rest());

  // 1/2 x^T H x + b^T x must be the cost of any step x, less that of none
  const KnotMatrix precision = vibrating();
  const auto cost = [&](const Eigen::VectorXd& x) {
    ScanTremor tremor;
    double sum = 0.5 * 1e5 * x.head<12>().squaredNorm();
    for (int k = 0; k < kKnots; ++k) {
      tremor.knots[std::size_t(k)] = x.segment<6>(12 + 6 * k);
      for (int l = 0; l < kKnots; ++l) {
        const Vector6d product = x.segment<6>(12 + 6 * k).cwiseProduct(x.segment<6>(12 + 6 * l));
        sum += 0.5 * precision(k, l) * product.cwiseQuotient(kSpread.variances()).sum();
      }
    }
    for (const FlatPair& pair : pairs.flat) {
      const Vector6d moved = x.head<6>() + pair.lever * x.segment<6>(6) + tremor.at(0.5 + 0.5 * pair.lever / kMiddle);
      const Eigen::Vector3d shift = moved.head<3>().cross(pair.point) + moved.tail<3>();
      sum += 0.5 * pair.information * std::pow(pair.residual + pair.normal.dot(shift), 2);
    }
    return sum;
  };
  const double at_none = cost(Eigen::VectorXd::Zero(TremblingSystem::kSize));
  std::normal_distribution<double> n(0, 3e-3);
  for (int i = 0; i < 20; ++i) {
    Eigen::VectorXd x(TremblingSystem::kSize);
    for (double& value : x) value = n(rng);
    const double expected = cost(x) - at_none;
    EXPECT_NEAR(0.5 * x.dot(system.H * x) + system.b.dot(x), expected, 1e-6 * std::abs(expected));
  }
}

TEST(Tremor, IsFoundWhereTheSurfacesShowIt) {
  std::mt19937 rng(3);
  const ScanTremor truth = some_tremor(2e-3, 1e-3, rng);
  const MotionState state = state_at_rest();
  const MovingParts parts = linearize(pairs_of(truth, 0.003, 4), state);
  Vector12d step;
  ScanTremor found;
  const TremblingSystem system = trembling_system(parts, sum_of(parts), prior_of(kSpread), state);
  ASSERT_TRUE(step_trembling(system, TremblingFactor(system.H), step, found));
  for (int k = 0; k < kKnots; ++k) {
    const double lever = kMiddle * (2.0 * k / ScanTremor::kIntervals - 1);
    const Vector6d motion = step.head<6>() + lever * step.tail<6>() + found.knots[std::size_t(k)];
    EXPECT_LT((motion - truth.knots[std::size_t(k)]).head<3>().norm(), 4e-4) << k;
    EXPECT_LT((motion - truth.knots[std::size_t(k)]).tail<3>().norm(), 1e-3) << k;
  }
}

TEST(Tremor, TheKnotsOfVibrationsAreCorrelatedAsThePriorSays) {
  std::mt19937 rng(8);
  KnotMatrix correlation = KnotMatrix::Zero();
  constexpr int kScans = 4000;
  for (int scan = 0; scan < kScans; ++scan) {
    const ScanTremor tremor = vibration(1, 1, rng);
    for (int k = 0; k < kKnots; ++k) {
      for (int l = 0; l < kKnots; ++l) {
        correlation(k, l) += tremor.knots[std::size_t(k)].dot(tremor.knots[std::size_t(l)]) / (6 * kScans);
      }
    }
  }
  EXPECT_LT((correlation - vibrating().inverse()).cwiseAbs().maxCoeff(), 0.12);  // of 5 to 25 Hz, as the defaults say
}

TEST(Tremor, AKnotIsBetterKnownByThoseBesideIt) {
  std::mt19937 rng(9);
  const MotionState state = state_at_rest();
  constexpr double kNoise = 0.1;
  double apart = 0, together = 0;
  for (std::uint32_t scan = 0; scan < 10; ++scan) {
    const ScanTremor truth = vibration(2e-3, 1e-3, rng);
    const MovingParts parts = linearize(pairs_of(truth, kNoise, scan), state);
    const auto error = [&](const KnotMatrix& precision) {
      TremorPrior prior = prior_of(kSpread, precision);
      prior.variances /= 1e5 * kNoise * kNoise;  // the residuals' variance, in those that the pairs promise
      const TremblingSystem system = trembling_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanTremor found;
      EXPECT_TRUE(step_trembling(system, TremblingFactor(system.H), step, found));
      double sum = 0;
      for (int k = 0; k < kKnots; ++k) {
        const double lever = kMiddle * (2.0 * k / ScanTremor::kIntervals - 1);
        const Vector6d motion = step.head<6>() + lever * step.tail<6>() + found.knots[std::size_t(k)];
        sum += (motion - truth.knots[std::size_t(k)]).head<3>().squaredNorm();
      }
      return sum;
    };
    apart += error(kApart);
    together += error(vibrating());
  }
  EXPECT_LT(together, 0.9 * apart);
}

TEST(Tremor, AddsToTheCovarianceOfThePose) {
  const MotionState state = state_at_rest();
  const MovingParts parts = linearize(pairs_of({}, 0.003, 4), state);
  const TremblingSystem system = trembling_system(parts, with_weak_prior(sum_of(parts)), prior_of(kSpread), state);
  const TremblingSystem::Matrix all = system.H.inverse();
  const int middle = 12 + 6 * (kKnots / 2);
  const Matrix6d cross = all.block<6, 6>(0, middle);
  const Matrix6d expected = all.topLeftCorner<6, 6>() + cross + cross.transpose() + all.block<6, 6>(middle, middle);
  const TremblingFactor factor(system.H);
  EXPECT_TRUE(covariance_in_middle(factor).isApprox(expected, 1e-9));
  const TremblingSystem still =
      trembling_system(parts, with_weak_prior(sum_of(parts)), prior_of({1e-7, 1e-7, 1e-7}), state);
  EXPECT_LT(covariance_in_middle(TremblingFactor(still.H)).trace(), 0.5 * covariance_in_middle(factor).trace());
}

TEST(Tremor, ItsSizeFollowsFromWhatScansShow) {
  TremorOptions options;
  options.tilt = options.yaw = 5e-3, options.least_rotation = 1e-3, options.first_tilt = 3e-3;
  for (const double rotation : {0.0, 3.5e-3}) {
    std::mt19937 rng(5);
    TremorEvidence evidence = first_evidence(options);
    EXPECT_GT(tremor_spread(evidence, options).tilt, 1.5 * options.least_rotation);
    EXPECT_LT(tremor_spread(evidence, options).tilt, options.first_tilt);
    for (std::uint32_t scan = 0; scan < 30; ++scan) {
      const MotionState state = state_at_rest();
      const MovingParts parts = linearize(pairs_of(vibration(rotation, 0, rng), 0.003, scan), state);
      const TremorPrior prior = prior_of(tremor_spread(evidence, options), vibrating());
      const TremblingSystem system = trembling_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanTremor found;
      const TremblingFactor factor(system.H);
      ASSERT_TRUE(step_trembling(system, factor, step, found));
      const TremorEvidence fresh = evidence_of(factor, prior, found);
      evidence = faded_sum(evidence, fresh, 2 * kMiddle);
    }
    const TremorSpread spread = tremor_spread(evidence, options);
    EXPECT_NEAR(spread.tilt, std::max(rotation, options.least_rotation), 6e-4);
    EXPECT_NEAR(spread.yaw, std::max(rotation, options.least_rotation), 6e-4);
    EXPECT_NEAR(spread.translation, options.least_translation, 2e-4);
  }
}

TEST(Tremor, ThePriorIsThatOfTheKnotsAndOfTheirMean) {
  TremorOptions options;
  options.mean = 0.4;
  std::mt19937 rng(6);
  const ScanTremor mean = some_tremor(1e-4, 1e-4, rng);
  constexpr double kShare = 0.05, kScale = 0.1;
  const TremorPrior prior = tremor_prior(kSpread, mean, {kShare, kScale}, options);
  const Vector6d s2 = kSpread.variances() / kScale;
  for (std::size_t k = 0; k < mean.knots.size(); ++k) {
    for (int i = 0; i < 6; ++i) {
      const auto cost = [&](double x) {
        const double left = (1 - kShare) * mean.knots[k][i] + kShare * x;
        const double mean_variance = options.mean * options.mean * s2[i] * kShare / 2;
        return 0.5 * x * x / s2[i] + 0.5 * left * left / mean_variance;
      };
      const double best = prior.means.knots[k][i], sigma = std::sqrt(prior.variances[i]);
      EXPECT_NEAR(cost(best + sigma) - cost(best), 0.5, 1e-6);
      EXPECT_NEAR(cost(best - sigma) - cost(best), 0.5, 1e-6);
    }
  }
  EXPECT_TRUE(prior.spread_variances.isApprox(s2));
}

TEST(Tremor, WhatStaysAtAnInstantIsTakenBack) {
  const TremorOptions options;
  const auto left_after_a_minute = [&](bool held) {
    ScanTremor mean;
    std::mt19937 rng(7);
    const MotionState state = state_at_rest();
    for (int scan = 0; scan < 300; ++scan) {
      ScanTremor crooked;  // the part of the map that is seen first is displaced
      crooked.knots[0][5] = 2e-3;
      const MovingParts parts = linearize(pairs_of(crooked, 0.003, std::uint32_t(scan % 5)), state);
      const double share = share_of_mean(0.1);
      const TremorPrior prior = held ? tremor_prior(kSpread, mean, {share}, options) : prior_of(kSpread);
      const TremblingSystem system = trembling_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanTremor found;
      EXPECT_TRUE(step_trembling(system, TremblingFactor(system.H), step, found));
      mean = mean_with(mean, found, share);
    }
    return mean.knots[0][5];
  };
  const double free = left_after_a_minute(false), held = left_after_a_minute(true);
  EXPECT_GT(free, 1e-4);
  EXPECT_LT(std::abs(held), 0.5 * free);
}

// A tenth of the patches that are seen at an instant is renewed with each scan. What is put where the scan seems to
// have been stays where it is; without the mean of the tremors it comes back.
TEST(Tremor, WithoutItsMeanAMapThatIsAstrayComesBack) {
  const TremorOptions options;
  constexpr double kAstray = 2e-3, kShareRenewed = 0.1;  // [m]
  const auto left_after_ten_seconds = [&](bool without_mean) {
    ScanTremor mean, map;
    map.knots[0][5] = kAstray;
    const MotionState state = state_at_rest();
    for (int scan = 0; scan < 100; ++scan) {
      const MovingParts parts = linearize(pairs_of(map, 0.003, std::uint32_t(scan % 5)), state);
      const double share = share_of_mean(0.1);
      const TremorPrior prior = tremor_prior(kSpread, mean, {share}, options);
      const TremblingSystem system = trembling_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanTremor found;
      EXPECT_TRUE(step_trembling(system, TremblingFactor(system.H), step, found));
      mean = mean_with(mean, found, share);
      const double put = (without_mean ? without(found, mean) : found).knots[0][5];
      map.knots[0][5] += kShareRenewed * (step[5] - kMiddle * step[11] + put - map.knots[0][5]);
    }
    return map.knots[0][5];
  };
  const double kept = left_after_ten_seconds(false), come_back = left_after_ten_seconds(true);
  EXPECT_GT(kept, 0.03 * kAstray);
  EXPECT_LT(std::abs(come_back), 0.6 * kept);
}

TEST(Tremor, ShakesAPlatformAsFarAsItTurnsIt) {
  TremorOptions options;
  TremorEvidence evidence;
  evidence.freedom.setConstant(1000);
  evidence.squares = 1000 * Eigen::Vector3d(1e-6, 1e-6, 4e-6);  // 1 mrad, 2 mm
  for (const double lever : {0.0, 0.5, 1.0, 3.0}) {
    options.lever = lever;
    const TremorSpread spread = tremor_spread(evidence, options);
    EXPECT_NEAR(spread.translation, std::min(2e-3, options.least_translation + lever * spread.tilt), 5e-5) << lever;
  }
  EXPECT_NEAR(seen_spread(evidence, options).translation, 2e-3, 5e-5);  // as it is seen, whatever is believed
}

TEST(Tremor, NoneWhereTheOptionsAllowNone) {
  TremorOptions options;
  EXPECT_FALSE(tremor_spread({}, options).none());
  options.tilt = 0;
  EXPECT_TRUE(tremor_spread({}, options).none());
  options = {.least_rotation = 0};
  EXPECT_TRUE(tremor_spread({}, options).none());
}

TEST(ScanTremor, IsLinearBetweenItsKnotsAndStaysAtItsEnds) {
  ScanTremor tremor;
  for (int k = 0; k < kKnots; ++k) tremor.knots[std::size_t(k)] = Vector6d::Constant(k * k);
  EXPECT_EQ(tremor.at(0)[0], 0);
  EXPECT_EQ(tremor.at(1)[0], 64);
  EXPECT_EQ(tremor.at(-1)[0], 0);
  EXPECT_EQ(tremor.at(2)[0], 64);
  EXPECT_DOUBLE_EQ(tremor.at(2.5 / 8)[0], 6.5);
}

}  // namespace
}  // namespace tilth
