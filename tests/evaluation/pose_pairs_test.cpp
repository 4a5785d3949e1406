// Which poses RPE compares.
#include <gtest/gtest.h>

#include "made_trajectories.hpp"
#include <tilth/core/error.hpp>
#include <tilth/evaluation/pose_pairs.hpp>

namespace tilth {
namespace {

using Pairs = std::vector<PosePair>;

TEST(PosePairs, Frames) {
  const Trajectory line = test::straight_line(6, 1);
  EXPECT_EQ(pose_pairs(line, {.delta = 2}), (Pairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(pose_pairs(line, {.delta = 2, .all_pairs = true}), (Pairs{{0, 2}, {1, 3}, {2, 4}, {3, 5}}));
  EXPECT_THROW(pose_pairs(line, {.delta = 6}), Error);
  EXPECT_THROW(pose_pairs(line, {.delta = 1.5}), Error);
  EXPECT_THROW(pose_pairs(line, {.delta = 0}), Error);
}

TEST(PosePairs, ConsecutiveMetresEndAtTheFirstPoseThatFar) {
  const Trajectory line = test::straight_line(8, 0.75);
  EXPECT_EQ(pose_pairs(line, {.delta = 1.5, .unit = DeltaUnit::meters}), (Pairs{{0, 2}, {2, 4}, {4, 6}}));
  EXPECT_EQ(pose_pairs(line, {.delta = 2, .unit = DeltaUnit::meters}), (Pairs{{0, 3}, {3, 6}}));
}

TEST(PosePairs, AllPairsInMetresAreTheNearestWithinTheTolerance) {
  const Trajectory line = test::straight_line(6, 0.75);
  const PairOptions near{.delta = 1.6, .unit = DeltaUnit::meters, .all_pairs = true, .tolerance = 0.1};
  EXPECT_EQ(pose_pairs(line, near), (Pairs{{0, 2}, {1, 3}, {2, 4}, {3, 5}}));
  const PairOptions nothing{.delta = 1.1, .unit = DeltaUnit::meters, .all_pairs = true, .tolerance = 0.1};
  EXPECT_THROW(pose_pairs(line, nothing), Error);
}

TEST(PosePairs, AtRestTheFirstOfEquallyFarPosesIsTaken) {
  Trajectory line = test::straight_line(4, 1);
  line.insert(line.begin() + 2, 3, line[1]);  // stands still after one metre
  const PairOptions metre{.delta = 1, .unit = DeltaUnit::meters, .all_pairs = true};
  EXPECT_EQ(pose_pairs(line, metre), (Pairs{{0, 1}, {1, 5}, {2, 5}, {3, 5}, {4, 5}, {5, 6}}));
}

TEST(PosePairs, SecondsWithStampsThatAreNotExact) {
  Trajectory line = test::straight_line(31, 0.2);
  for (std::size_t i = 0; i < line.size(); ++i) line[i].stamp = 1.6e9 + 0.1 * double(i);
  EXPECT_EQ(pose_pairs(line, {.delta = 1, .unit = DeltaUnit::seconds}), (Pairs{{0, 10}, {10, 20}, {20, 30}}));
  EXPECT_EQ(pose_pairs(line, {.delta = 1, .unit = DeltaUnit::seconds, .all_pairs = true, .tolerance = 0.05}).size(),
            21u);
}

TEST(PosePairs, SecondsGoOnAfterAGap) {
  Trajectory line = test::straight_line(9, 1);
  for (std::size_t i = 3; i < line.size(); ++i) line[i].stamp += 7.5;
  EXPECT_EQ(pose_pairs(line, {.delta = 2, .unit = DeltaUnit::seconds}), (Pairs{{0, 2}, {3, 5}, {5, 7}}));
  EXPECT_THROW(pose_pairs(line, {.delta = 100, .unit = DeltaUnit::seconds}), Error);
}

}  // namespace
}  // namespace tilth
