// The motion within a scan, against its velocity integrated in small steps.
#include <gtest/gtest.h>

#include <tilth/core/scan_motion.hpp>

namespace tilth {
namespace {

constexpr double kMiddle = 0.05, kDuration = 0.1;  // [s]

MotionInScan some_motion() {
  MotionInScan motion;
  motion.velocity << 0.2, -0.1, 1.5, 2.0, -0.3, 0.1;
  motion.acceleration << 0.3, -0.2, 6.0, 3.0, 1.0, -0.5;
  motion.begin = -kMiddle, motion.duration = kDuration;
  return motion;
}

MotionInScan shaking_motion() {
  MotionInScan motion = some_motion();
  for (std::size_t i = 0; i < motion.vibration.knots.size(); ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    motion.vibration.knots[i] = sign * (Vector6d() << 2e-3, -1e-3, 1e-3, 1e-3, 2e-3, -1e-3).finished();
  }
  return motion;
}

TEST(ScanMotion, IsTheIntegralOfItsVelocity) {
  const MotionInScan motion = some_motion();
  const ScanMotion in_scan(motion, kMiddle);
  constexpr int kSteps = 5000;
  for (const double end : {-0.01, 0.0, 0.0123, 0.09, 0.1, 0.11}) {
    const double step = (end - kMiddle) / kSteps;
    Pose T_middle_end = Pose::Identity();
    for (int i = 0; i < kSteps; ++i) {
      const double lever = (i + 0.5) * step;
      T_middle_end = T_middle_end * exp(step * (motion.velocity + lever * motion.acceleration));
    }
    const Eigen::Vector3d p(12, -7, 1);
    EXPECT_LT((in_scan.move(p, end) - T_middle_end * p).norm(), 5e-4) << end;
    EXPECT_LT((in_scan.at(end) * p - T_middle_end * p).norm(), 5e-4) << end;
  }
}

TEST(ScanMotion, IsTheSameSeenFromAnotherInstant) {
  const MotionInScan motion = shaking_motion();
  const double ratio = 0.75;
  const ScanMotion middle(motion, kMiddle);
  const ScanMotion later(motion.from((ratio - 0.5) * kDuration), ratio * kDuration);
  const Pose T_middle_later = middle.at(ratio * kDuration);
  const Eigen::Vector3d p(12, -7, 1);
  for (const double time : {0.0, 0.0125, 0.05, 0.0875, 0.1}) {
    EXPECT_LT((T_middle_later * later.move(p, time) - middle.move(p, time)).norm(), 4e-3) << time << ": 0.3 mrad";
  }
}

TEST(MotionInScan, WhatOnlyVibratesIsNotAtRest) {
  EXPECT_TRUE(MotionInScan::steady(Vector6d::Zero(), kMiddle).at_rest());
  EXPECT_FALSE(MotionInScan{.vibration = shaking_motion().vibration}.at_rest());
}

}  // namespace
}  // namespace tilth
