// A pipeline that learns the errors of its sensor's beams on the way, on a simulated drive.
#include <gtest/gtest.h>

#include <tilth/odometry/beam_learning_odometry.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

/// A drive past furniture with a worn sensor, long enough for three windows.
const std::vector<Scan>& worn_drive() {
  static const std::vector<Scan> scans = [] {
    std::vector<Scan> all;
    const auto source = open_source("sim://corridor?seed=61&beams=worn&speed=2&duration=27", {});
    while (auto scan = source->next()) all.push_back(std::move(*scan));
    return all;
  }();
  return scans;
}

std::vector<Pose> poses_of(Odometry& odometry) {
  std::vector<Pose> poses;
  for (const Scan& scan : worn_drive()) poses.push_back(odometry.register_scan(scan).T_world_lidar);
  return poses;
}

TEST(BeamLearningOdometry, WatchesWithoutTouchingThePoses) {
  const auto plain = make_odometry("tilth");
  const auto learner = std::make_shared<BeamLearner>(BeamCalibrationOptions{});
  BeamLearningOdometry watching(make_odometry("tilth"), learner, BeamLearning::watch);
  const std::vector<Pose> expected = poses_of(*plain), poses = poses_of(watching);
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].matrix(), expected[i].matrix()) << i;
  ASSERT_TRUE(learner->found());
  EXPECT_GT(learner->found()->believed, 5U);
}

TEST(BeamLearningOdometry, MakesSurfacesThinnerWhereItCorrects) {
  const auto learner = std::make_shared<BeamLearner>(BeamCalibrationOptions{});
  BeamLearningOdometry learning(make_odometry("tilth"), learner, BeamLearning::correct);
  poses_of(learning);
  ASSERT_TRUE(learner->found());
  EXPECT_LT(learner->found()->after.thickness, 0.8 * learner->found()->before.thickness);
}

TEST(BeamLearningOdometry, TakesScansWithoutRingsAsTheyAre) {
  const auto learner = std::make_shared<BeamLearner>(BeamCalibrationOptions{});
  BeamLearningOdometry learning(make_odometry("tilth"), learner, BeamLearning::correct);
  const auto scans = open_source("sim://plaza?seed=61&sensor=rosette&duration=1", {});
  while (const auto scan = scans->next()) learning.register_scan(*scan);
  EXPECT_FALSE(learner->found());
}

}  // namespace
}  // namespace tilth
