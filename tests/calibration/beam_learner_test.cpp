// Errors of beams that are learned window by window, against the truth of a made drive.
#include <calibration/flawed_drive.hpp>

#include <gtest/gtest.h>

#include <tilth/calibration/beam_learner.hpp>

namespace tilth {
namespace {

constexpr double kBright = 200;

/// Adds the windows one by one and does all work there is; how often the beams to correct by changed.
int learn(BeamLearner& learner, KeyframeWindows windows) {
  int changes = 0;
  for (auto& window : windows) {
    learner.add(std::move(window), kDriveBeams, kBright);
    for (int i = 0; i < 100; ++i) changes += int(learner.work());
  }
  return changes;
}

double range_error(const BeamModel& found, const BeamModel& truth) {
  Eigen::ArrayXd errors(kDriveBeams);
  for (std::size_t k = 0; k < kDriveBeams; ++k) errors[Eigen::Index(k)] = found.range[k] - truth.range[k];
  return std::sqrt((errors - errors.mean()).square().mean());
}

TEST(BeamLearner, FindsTheErrorsOfWornBeamsAsTheyAreDriven) {
  const BeamModel truth = worn_beams(21);
  BeamLearner learner(BeamCalibrationOptions{});
  EXPECT_GE(learn(learner, windows_of({truth, 0.01, 21}, 12)), 3);
  ASSERT_TRUE(learner.found());
  EXPECT_EQ(learner.found()->windows, 12U);
  EXPECT_LT(range_error(learner.beams(), truth), 0.002);
  EXPECT_LT((learner.beams().encoder - truth.encoder).norm(), 2e-4);
  EXPECT_LT(learner.found()->after.thickness, 0.9 * learner.found()->before.thickness);
}

TEST(BeamLearner, SaysNothingBeforeThreeWindows) {
  BeamLearner learner(BeamCalibrationOptions{});
  EXPECT_EQ(learn(learner, windows_of({worn_beams(22), 0.01, 22}, 2)), 0);
  EXPECT_FALSE(learner.found());
  EXPECT_TRUE(learner.beams().ideal());
}

TEST(BeamLearner, LeavesIdealBeamsAlone) {
  BeamLearner learner(BeamCalibrationOptions{});
  learn(learner, windows_of({ideal_beams(), 0.02, 23}, 12));
  ASSERT_TRUE(learner.found());
  EXPECT_LE(learner.found()->believed, 1U);
  for (const double range : learner.beams().range) EXPECT_LT(std::abs(range), 0.001);
}

TEST(BeamLearner, GivesTheSameErrorsAgain) {
  BeamLearner one(BeamCalibrationOptions{}), other(BeamCalibrationOptions{});
  const FlawedDrive drive{worn_beams(24), 0.01, 24};
  learn(one, windows_of(drive, 6)), learn(other, windows_of(drive, 6));
  EXPECT_EQ(one.beams().range, other.beams().range);
  EXPECT_EQ(one.beams().elevation, other.beams().elevation);
}

TEST(BeamLearner, AddsWhatItFindsToWhatScansAreCorrectedByAlready) {
  const BeamModel rest = worn_beams(25);
  BeamEstimate known = prior_beams(kDriveBeams, kBright, {});
  known.model.range.assign(kDriveBeams, 0.1);
  BeamLearner learner(BeamCalibrationOptions{}, known);
  learn(learner, windows_of({rest, 0.01, 25}, 6));
  ASSERT_TRUE(learner.found());
  for (std::size_t k = 0; k < kDriveBeams; ++k)
    EXPECT_NEAR(learner.found()->beams.model.range[k], 0.1 + learner.beams().range[k], 1e-12);
  EXPECT_LT(range_error(learner.beams(), rest), 0.003);
}

TEST(BeamLearner, BeginsAnewWhereTheSensorHasMoreBeamsThanItSeemed) {
  BeamLearner learner(BeamCalibrationOptions{});
  learn(learner, windows_of({worn_beams(26), 0.01, 26}, 4));
  ASSERT_TRUE(learner.found());
  learner.add(windows_of({worn_beams(26), 0.01, 27}, 1)[0], kDriveBeams + 1, kBright);
  EXPECT_FALSE(learner.found());
  EXPECT_TRUE(learner.beams().ideal());
  EXPECT_EQ(learner.beams().beams(), kDriveBeams + 1);
}

}  // namespace
}  // namespace tilth
