// Scans of a LiDAR that trembles, as pairs of patches all around, and what is found of their tremor.
#pragma once

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/registration/tremor.hpp>

namespace tilth {

constexpr double kMiddle = 0.05;  // [s]
constexpr int kKnots = ScanTremor::kIntervals + 1;
inline const TremorSpread kSpread{2e-3, 1.5e-3, 1e-3};

/// Of knots that tell nothing about each other.
inline const KnotMatrix kApart = KnotMatrix::Identity();

/// Of vibrations.
inline KnotMatrix vibrating() {
  return knot_precision(2 * kMiddle, TremorOptions());
}

/// Nothing known but the spread.
inline TremorPrior prior_of(const TremorSpread& spread, const KnotMatrix& precision = kApart) {
  return tremor_prior(spread, {}, {.precision = precision}, TremorOptions());
}

/// Pairs of flat patches all around, whose residuals are those of a LiDAR that deviates by `tremor`, and of noise [m].
inline PatchPairs pairs_of(const ScanTremor& tremor, double noise, std::uint32_t seed) {
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

inline ScanTremor some_tremor(double rotation, double translation, std::mt19937& rng) {
  std::normal_distribution<double> n(0, 1);
  ScanTremor tremor;
  for (Vector6d& knot : tremor.knots) {
    for (int i = 0; i < 6; ++i) knot[i] = (i < 3 ? rotation : translation) * n(rng);
  }
  return tremor;
}

/// Tones of 6 to 24 Hz.
inline ScanTremor vibration(double rotation, double translation, std::mt19937& rng) {
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

inline MotionState state_at_rest() {
  MotionState state;
  state.middle = kMiddle;
  state.kernel_width = 1e6;
  return state;
}

inline MovingSystem with_weak_prior(MovingSystem system) {
  system.H.diagonal().array() += 1e5;
  return system;
}

struct FoundTremor {
  Vector12d step = Vector12d::Zero();
  ScanTremor tremor = {};
};

inline FoundTremor found(const MovingParts& parts, const TremorPrior& prior, const MotionState& state) {
  const TremblingSystem system = trembling_system(parts, with_weak_prior(sum_of(parts)), prior, state);
  FoundTremor found;
  EXPECT_TRUE(step_trembling(system, TremblingFactor(system.H), found.step, found.tremor));
  return found;
}

}  // namespace tilth
