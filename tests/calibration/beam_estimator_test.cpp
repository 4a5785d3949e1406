#include <calibration/flawed_drive.hpp>

#include <gtest/gtest.h>

namespace tilth {
namespace {

BeamCalibration calibrated(const FlawedDrive& drive, std::size_t windows) {
  const BeamCalibrationOptions options;
  return estimate_beams(windows_of(drive, windows), prior_beams(kDriveBeams, 200, options), options);
}

/// [m] root mean square, but for what all beams have in common, of which a small room shows little.
double range_error(const BeamModel& found, const BeamModel& truth) {
  Eigen::ArrayXd errors(kDriveBeams);
  for (std::size_t k = 0; k < kDriveBeams; ++k) errors[Eigen::Index(k)] = found.range[k] - truth.range[k];
  return std::sqrt((errors - errors.mean()).square().mean());
}

TEST(BeamEstimator, FindsTheErrorsOfWornBeams) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const BeamModel truth = worn_beams(seed);
    const BeamCalibration found = calibrated({truth, 0.01, seed}, 12);
    EXPECT_LT(range_error(found.beams.model, truth), 0.002) << seed;
    EXPECT_NEAR(found.beams.model.walk, truth.walk, 0.002) << seed;
    EXPECT_LT((found.beams.model.encoder - truth.encoder).norm(), 2e-4) << seed;
    EXPECT_LT(found.after.thickness, 0.9 * found.before.thickness) << seed;
    for (const double residual : found.after.residual) EXPECT_LT(std::abs(residual), 0.001) << seed;
  }
}

TEST(BeamEstimator, ItsDeviationsHoldItsErrors) {
  std::size_t within = 0, all = 0;
  for (const std::uint32_t seed : {4U, 5U, 6U}) {
    const BeamModel truth = worn_beams(seed);
    const BeamEstimate found = calibrated({truth, 0.01, seed}, 12).beams;
    const Eigen::VectorXd error = parameters_of(found.model, kDriveBeams) - parameters_of(truth, kDriveBeams);
    for (Eigen::Index i = 0; i < error.size(); ++i, ++all) {
      within += std::size_t(std::abs(error[i]) < 2 * std::sqrt(found.covariance(i, i)));
    }
  }
  EXPECT_GE(double(within), 0.9 * double(all));
}

TEST(BeamEstimator, IdealBeamsHaveNothingToCorrect) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const BeamCalibration found = calibrated({ideal_beams(), 0.02, seed}, 12);
    EXPECT_LE(found.believed, 1U) << seed;
    for (const double range : found.beams.model.range) EXPECT_LT(std::abs(range), 0.001) << seed;
  }
}

TEST(BeamEstimator, WhatWindowsDoNotAgreeOnIsNotBelieved) {
  BeamModel one = ideal_beams(), other = ideal_beams();
  one.range = worn_beams(8).range, other.range = one.range;
  for (double& range : other.range) range = -range;
  KeyframeWindows windows = windows_of({one, 0.01, 1}, 6);
  for (auto& window : windows_of({other, 0.01, 2}, 6)) windows.push_back(std::move(window));
  const BeamCalibrationOptions options;
  const BeamCalibration found = estimate_beams(std::move(windows), prior_beams(kDriveBeams, 200, options), options);
  EXPECT_LE(found.believed, 3U);
  for (std::size_t k = 0; k < kDriveBeams; ++k) EXPECT_LT(std::abs(found.beams.model.range[k]), 0.005) << k;
}

TEST(BeamEstimator, ASecondDriveGoesOnFromTheFirst) {
  const BeamModel truth = worn_beams(9);
  const BeamCalibrationOptions options;
  const BeamCalibration first = calibrated({truth, 0.01, 1}, 6);
  const BeamCalibration second = estimate_beams(windows_of({truth, 0.01, 2}, 6), first.beams, options);
  EXPECT_LT(range_error(second.beams.model, truth), 0.002);
  EXPECT_LT(second.before.thickness, 1.1 * first.after.thickness);
  EXPECT_LE(second.beams.covariance.trace(), 1.01 * first.beams.covariance.trace());
}

}  // namespace
}  // namespace tilth
