// Scans of a LiDAR that vibrates, as pairs of patches all around, and what is found of their vibration.
#pragma once

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/registration/vibration.hpp>

namespace tilth {

constexpr double kMiddle = 0.05;  // [s]
constexpr int kKnots = ScanVibration::kIntervals + 1;
inline const VibrationSigma kSpread{2e-3, 1.5e-3, 1e-3};

/// Of knots that tell nothing about each other.
inline const KnotMatrix kApart = KnotMatrix::Identity();

/// Of vibrations.
inline KnotMatrix vibrating() {
  return knot_precision(2 * kMiddle, VibrationOptions());
}

/// Nothing known but the size.
inline VibrationPrior prior_of(const VibrationSigma& sigma, const KnotMatrix& precision = kApart) {
  return vibration_prior(sigma, {}, {.precision = precision}, VibrationOptions());
}

/// Pairs of flat patches all around, whose residuals are those of a LiDAR that deviates by `vibration`, and of noise
/// [m].
inline PatchPairs pairs_of(const ScanVibration& vibration, double noise, std::uint32_t seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::normal_distribution<double> error(0, noise);
  PatchPairs pairs;
  for (int i = 0; i < 3000; ++i) {
    const double x = u(rng), y = u(rng), z = u(rng), a = u(rng), b = u(rng), c = u(rng), lever = kMiddle * u(rng);
    const Eigen::Vector3d point = 8 * Eigen::Vector3d(x, y, z), normal = Eigen::Vector3d(a, b, c).normalized();
    const Vector6d moved = vibration.at(0.5 + 0.5 * lever / kMiddle);
    const Eigen::Vector3d shift = moved.head<3>().cross(point) + moved.tail<3>();
    pairs.flat.push_back({point, normal, error(rng) - normal.dot(shift), 1e5, lever});
  }
  return pairs;
}

inline ScanVibration some_vibration(double rotation, double translation, std::mt19937& rng) {
  std::normal_distribution<double> n(0, 1);
  ScanVibration vibration;
  for (Vector6d& knot : vibration.knots) {
    for (int i = 0; i < 6; ++i) knot[i] = (i < 3 ? rotation : translation) * n(rng);
  }
  return vibration;
}

/// Tones of 6 to 24 Hz.
inline ScanVibration tones(double rotation, double translation, std::mt19937& rng) {
  constexpr int kTones = 12;
  std::uniform_real_distribution<double> frequency(6, 24), phase(0, 2 * std::numbers::pi);
  ScanVibration vibration;
  for (int i = 0; i < 6; ++i) {
    for (int tone = 0; tone < kTones; ++tone) {
      const double turns = frequency(rng), from = phase(rng);
      for (int k = 0; k < kKnots; ++k) {
        const double time = 2 * kMiddle * k / ScanVibration::kIntervals;
        vibration.knots[std::size_t(k)][i] += (i < 3 ? rotation : translation) * std::sqrt(2.0 / kTones) *
                                              std::sin(2 * std::numbers::pi * turns * time + from);
      }
    }
  }
  return vibration;
}

inline MotionState state_at_rest() {
  MotionState state;
  state.motion = MotionInScan::steady(Vector6d::Zero(), kMiddle);
  state.middle = kMiddle;
  state.kernel_width = 1e6;
  return state;
}

inline ContinuousTimeSystem with_weak_prior(ContinuousTimeSystem system) {
  system.H.diagonal().array() += 1e5;
  return system;
}

struct FoundVibration {
  Vector12d step = Vector12d::Zero();
  ScanVibration vibration = {};
};

inline FoundVibration found(const SegmentSystems& parts, const VibrationPrior& prior, const MotionState& state) {
  const VibrationSystem system = vibration_system(parts, with_weak_prior(sum_of(parts)), prior, state);
  FoundVibration found;
  EXPECT_TRUE(step_with_vibration(system, factor_of(system), found.step, found.vibration));
  return found;
}

}  // namespace tilth
