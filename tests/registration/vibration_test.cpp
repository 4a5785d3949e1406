// The vibration of a scan: its system against a quadratic cost written out, and what it finds.
#include <Eigen/LU>

#include "made_vibrations.hpp"

namespace tilth {
namespace {

TEST(Vibration, TheSystemIsThatOfTheQuadraticCost) {
  std::mt19937 rng(1);
  const PatchPairs pairs = pairs_of(some_vibration(3e-3, 3e-3, rng), 0.01, 2);
  const SegmentSystems parts = linearize(pairs, state_at_rest());
  const VibrationSystem system =
      vibration_system(parts, with_weak_prior(sum_of(parts)), prior_of(kSpread, vibrating()), state_at_rest());

  // 1/2 x^T H x + b^T x must be the cost of any step x, less that of none
  const KnotMatrix precision = vibrating();
  const auto cost = [&](const Eigen::VectorXd& x) {
    ScanVibration vibration;
    double sum = 0.5 * 1e5 * x.head<12>().squaredNorm();
    for (int k = 0; k < kKnots; ++k) {
      vibration.knots[std::size_t(k)] = x.segment<6>(12 + 6 * k);
      for (int l = 0; l < kKnots; ++l) {
        const Vector6d product = x.segment<6>(12 + 6 * k).cwiseProduct(x.segment<6>(12 + 6 * l));
        sum += 0.5 * precision(k, l) * product.cwiseQuotient(kSpread.variances()).sum();
      }
    }
    for (const FlatPair& pair : pairs.flat) {
      const Vector6d moved =
          x.head<6>() + pair.lever * x.segment<6>(6) + vibration.at(0.5 + 0.5 * pair.lever / kMiddle);
      const Eigen::Vector3d shift = moved.head<3>().cross(pair.point) + moved.tail<3>();
      sum += 0.5 * pair.information * std::pow(pair.residual + pair.normal.dot(shift), 2);
    }
    return sum;
  };
  const double at_none = cost(Eigen::VectorXd::Zero(VibrationSystem::kSize));
  std::normal_distribution<double> n(0, 3e-3);
  for (int i = 0; i < 20; ++i) {
    Eigen::VectorXd x(VibrationSystem::kSize);
    for (double& value : x) value = n(rng);
    const double expected = cost(x) - at_none;
    EXPECT_NEAR(0.5 * x.dot(system.H * x) + system.b.dot(x), expected, 1e-6 * std::abs(expected));
  }
}

TEST(Vibration, IsFoundWhereTheSurfacesShowIt) {
  std::mt19937 rng(3);
  const ScanVibration truth = some_vibration(2e-3, 1e-3, rng);
  const MotionState state = state_at_rest();
  const SegmentSystems parts = linearize(pairs_of(truth, 0.003, 4), state);
  Vector12d step;
  ScanVibration found;
  const VibrationSystem system = vibration_system(parts, sum_of(parts), prior_of(kSpread), state);
  ASSERT_TRUE(step_with_vibration(system, factor_of(system), step, found));
  for (int k = 0; k < kKnots; ++k) {
    const double lever = kMiddle * (2.0 * k / ScanVibration::kIntervals - 1);
    const Vector6d motion = step.head<6>() + lever * step.tail<6>() + found.knots[std::size_t(k)];
    EXPECT_LT((motion - truth.knots[std::size_t(k)]).head<3>().norm(), 4e-4) << k;
    EXPECT_LT((motion - truth.knots[std::size_t(k)]).tail<3>().norm(), 1e-3) << k;
  }
}

TEST(Vibration, TheKnotsOfVibrationsAreCorrelatedAsThePriorSays) {
  std::mt19937 rng(8);
  KnotMatrix correlation = KnotMatrix::Zero();
  constexpr int kScans = 4000;
  for (int scan = 0; scan < kScans; ++scan) {
    const ScanVibration vibration = tones(1, 1, rng);
    for (int k = 0; k < kKnots; ++k) {
      for (int l = 0; l < kKnots; ++l) {
        correlation(k, l) += vibration.knots[std::size_t(k)].dot(vibration.knots[std::size_t(l)]) / (6 * kScans);
      }
    }
  }
  EXPECT_LT((correlation - vibrating().inverse()).cwiseAbs().maxCoeff(), 0.12);  // of 5 to 25 Hz, as the defaults say
}

TEST(Vibration, AKnotIsBetterKnownByThoseBesideIt) {
  std::mt19937 rng(9);
  const MotionState state = state_at_rest();
  constexpr double kNoise = 0.1;
  double apart = 0, together = 0;
  for (std::uint32_t scan = 0; scan < 10; ++scan) {
    const ScanVibration truth = tones(2e-3, 1e-3, rng);
    const SegmentSystems parts = linearize(pairs_of(truth, kNoise, scan), state);
    const auto error = [&](const KnotMatrix& precision) {
      VibrationPrior prior = prior_of(kSpread, precision);
      prior.variances /= 1e5 * kNoise * kNoise;  // the residuals' variance, in those that the pairs promise
      const VibrationSystem system = vibration_system(parts, with_weak_prior(sum_of(parts)), prior, state);
      Vector12d step;
      ScanVibration found;
      EXPECT_TRUE(step_with_vibration(system, factor_of(system), step, found));
      double sum = 0;
      for (int k = 0; k < kKnots; ++k) {
        const double lever = kMiddle * (2.0 * k / ScanVibration::kIntervals - 1);
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

TEST(Vibration, AddsToTheCovarianceOfThePose) {
  const MotionState state = state_at_rest();
  const SegmentSystems parts = linearize(pairs_of({}, 0.003, 4), state);
  const VibrationSystem system = vibration_system(parts, with_weak_prior(sum_of(parts)), prior_of(kSpread), state);
  const VibrationSystem::Matrix all = system.H.inverse();
  const int middle = 12 + 6 * (kKnots / 2);
  const Matrix6d cross = all.block<6, 6>(0, middle);
  const Matrix6d expected = all.topLeftCorner<6, 6>() + cross + cross.transpose() + all.block<6, 6>(middle, middle);
  const VibrationFactor factor = factor_of(system);
  EXPECT_TRUE(covariance_in_middle(factor).isApprox(expected, 1e-9));
  const VibrationSystem still =
      vibration_system(parts, with_weak_prior(sum_of(parts)), prior_of({1e-7, 1e-7, 1e-7}), state);
  EXPECT_LT(covariance_in_middle(factor_of(still)).trace(), 0.5 * covariance_in_middle(factor).trace());
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

TEST(ScanVibration, IsLinearBetweenItsKnotsAndStaysAtItsEnds) {
  ScanVibration vibration;
  for (int k = 0; k < kKnots; ++k) vibration.knots[std::size_t(k)] = Vector6d::Constant(k * k);
  EXPECT_EQ(vibration.at(0)[0], 0);
  EXPECT_EQ(vibration.at(1)[0], 64);
  EXPECT_EQ(vibration.at(-1)[0], 0);
  EXPECT_EQ(vibration.at(2)[0], 64);
  EXPECT_DOUBLE_EQ(vibration.at(2.5 / 8)[0], 6.5);
}

}  // namespace
}  // namespace tilth
