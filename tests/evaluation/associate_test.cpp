// Which stamps match which.
#include <gtest/gtest.h>

#include "made_trajectories.hpp"
#include <tilth/core/error.hpp>
#include <tilth/evaluation/associate.hpp>

namespace tilth {
namespace {

Trajectory at(const std::vector<double>& stamps) {
  Trajectory trajectory;
  for (const double t : stamps) trajectory.push_back({t, Pose(Eigen::Translation3d(t, 0, 0))});
  return trajectory;
}

std::vector<double> stamps_of(const Trajectory& trajectory) {
  std::vector<double> stamps;
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp);
  return stamps;
}

using Stamps = std::vector<double>;

TEST(Associate, TakesTheNearestStampWithinMaxDt) {
  const MatchedPoses matches = associate(at({0, 1, 2, 3, 4}), at({0.9, 2.25, 3.5}), {.max_dt = 0.3});
  EXPECT_EQ(stamps_of(matches.truth), (Stamps{1, 2}));
  EXPECT_EQ(stamps_of(matches.estimate), (Stamps{0.9, 2.25}));
}

TEST(Associate, TheShorterTrajectoryChooses) {
  const MatchedPoses matches = associate(at({1, 3}), at({0.5, 1.25, 1.5, 2.75, 3.5}), {.max_dt = 0.5});
  EXPECT_EQ(stamps_of(matches.truth), (Stamps{1, 3}));
  EXPECT_EQ(stamps_of(matches.estimate), (Stamps{1.25, 2.75}));
}

TEST(Associate, OfTwoEquallyNearTheEarlierIsTaken) {
  EXPECT_EQ(stamps_of(associate(at({0, 1, 2}), at({0.5, 1.5}), {.max_dt = 0.5}).truth), (Stamps{0, 1}));
}

TEST(Associate, OnePoseMayBeTakenTwice) {
  EXPECT_EQ(stamps_of(associate(at({0, 1, 5}), at({0.75, 1.25}), {.max_dt = 0.5}).truth), (Stamps{1, 1}));
}

TEST(Associate, OffsetIsAddedToTheEstimate) {
  const StampAssociationOptions options{.max_dt = 0.01, .time_offset = 0.5};
  EXPECT_EQ(stamps_of(associate(at({0, 1, 2}), at({0.5, 1.5}), options).truth), (Stamps{1, 2}));
  EXPECT_EQ(stamps_of(associate(at({1, 2}), at({-0.5, 0.5, 1.5}), options).estimate), (Stamps{0.5, 1.5}));
}

TEST(Associate, InterpolatesWithinTheTruthOnly) {
  Trajectory truth = at({0, 2, 4});
  truth[2].T_world_lidar.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const MatchedPoses matches = associate(truth, at({-1, 0, 1, 3.5, 4, 5}), {.interpolate = true});
  ASSERT_EQ(stamps_of(matches.estimate), (Stamps{0, 1, 3.5, 4}));
  for (const StampedPose& pose : matches.truth) EXPECT_NEAR(pose.T_world_lidar.translation().x(), pose.stamp, 1e-15);
  EXPECT_NEAR(angle_of(matches.truth[1].T_world_lidar), 0, 1e-15);
  EXPECT_NEAR(angle_of(matches.truth[2].T_world_lidar), 0.75, 1e-15);
  EXPECT_NEAR(angle_of(matches.truth[3].T_world_lidar), 1, 1e-15);
}

TEST(Associate, DoesNotInterpolateOverAGap) {
  const Trajectory truth = at({0, 0.1, 0.2, 0.3, 3.3, 3.4, 3.5}), estimate = at({0.15, 0.3, 0.35, 1, 3, 3.3, 3.45});
  const MatchedPoses matches = associate(truth, estimate, {.interpolate = true});
  EXPECT_EQ(stamps_of(matches.estimate), (Stamps{0.15, 0.3, 3.3, 3.45})) << "at its ends the truth is known";
  ASSERT_EQ(matches.gaps.size(), 1u);
  EXPECT_EQ(matches.gaps[0].from, 0.3);
  EXPECT_EQ(matches.gaps[0].to, 3.3);
  EXPECT_EQ(matches.gaps[0].left_out, 3u);
  const MatchedPoses all = associate(truth, estimate, {.interpolate = true, .max_gap = 3});
  EXPECT_EQ(all.estimate.size(), estimate.size());
  EXPECT_TRUE(all.gaps.empty());
}

TEST(Associate, TheLimitOfGapsGoesWithTheRateOfTheTruth) {
  EXPECT_DOUBLE_EQ(gap_limit(at({0, 1, 2, 3, 10}), {}), 3) << "three median intervals";
  EXPECT_DOUBLE_EQ(gap_limit(at({0, 0.005, 0.01, 0.015}), {}), 0.2) << "a fifth of a second at least";
  EXPECT_DOUBLE_EQ(gap_limit(at({0, 1, 2, 3}), {.max_gap = 0.5}), 0.5);
  EXPECT_EQ(associate(at({0, 1, 2, 5, 6}), at({3.5}), {.interpolate = true}).gaps.size(), 0u)
      << "three intervals, not more";
}

TEST(Associate, NothingButGapsSaysSo) {
  try {
    associate(at({0, 0.1, 0.2, 9}), at({4, 5}), {.interpolate = true});
    FAIL() << "should be refused";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("outside its gaps"), std::string::npos) << e.what();
  }
}

TEST(Associate, NoMatchSaysBothTimeRanges) {
  try {
    associate(at({0, 1, 2}), at({100, 101}), {.max_dt = 0.25});
    FAIL() << "should be refused";
  } catch (const Error& e) {
    for (const char* part :
         {"0.000000 s to 2.000000 s", "100.000000 s to 101.000000 s", "0.25", "3 poses", "2 poses"}) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(associate(at({0, 1}), at({2, 3}), {.interpolate = true}), Error);
  EXPECT_THROW(associate({}, at({2, 3}), {}), Error);
  EXPECT_THROW(associate(at({2, 3}), {}, {}), Error);
}

TEST(Associate, ByIndexNeedsEqualNumbers) {
  EXPECT_EQ(associate_by_index(at({0, 1}), at({5, 6})).truth.size(), 2u);
  EXPECT_THROW(associate_by_index(at({0, 1}), at({5})), Error);
}

}  // namespace
}  // namespace tilth
