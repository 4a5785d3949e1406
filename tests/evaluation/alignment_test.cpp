// Alignment finds the transform that was put in, and refuses what does not determine one.
#include <gtest/gtest.h>

#include "made_trajectories.hpp"
#include <tilth/core/error.hpp>
#include <tilth/evaluation/alignment.hpp>

namespace tilth {
namespace {

double largest_gap(const Trajectory& a, const Trajectory& b) {
  double gap = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    gap = std::max(gap, (a[i].T_world_lidar.matrix() - b[i].T_world_lidar.matrix()).cwiseAbs().maxCoeff());
  }
  return gap;
}

class RecoversTheFrame : public testing::TestWithParam<Alignment> {};

TEST_P(RecoversTheFrame, OfARandomWalk) {
  const Trajectory truth = test::random_walk(100, 1);
  const MatchedPoses matches{truth, test::moved(truth, test::some_pose())};
  const Similarity S = alignment_of(matches, GetParam());
  EXPECT_LT(largest_gap(transform(matches.estimate, S), truth), 1e-11);
  EXPECT_LT((S.rotation - test::some_pose().inverse().linear()).norm(), 1e-12);
  EXPECT_NEAR(S.scale, 1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, RecoversTheFrame, testing::Values(Alignment::origin, Alignment::se3, Alignment::sim3));

TEST(Alignment, RecoversTheScale) {
  const Trajectory truth = test::random_walk(100, 2);
  const Trajectory estimate = transform(truth, {0.25, test::some_pose().linear(), {1, 2, 3}});
  const Similarity S = alignment_of({truth, estimate}, Alignment::sim3);
  EXPECT_NEAR(S.scale, 4, 1e-11);
  EXPECT_LT(largest_gap(transform(estimate, S), truth), 1e-11);
}

TEST(Alignment, NoneLeavesTheEstimate) {
  const Trajectory truth = test::random_walk(10, 3), estimate = test::moved(truth, test::some_pose());
  EXPECT_EQ(largest_gap(transform(estimate, alignment_of({truth, estimate}, Alignment::none)), estimate), 0);
}

TEST(Alignment, IsARotationWhereAReflectionWouldFitBetter) {
  const Trajectory truth = test::random_walk(50, 4);
  Trajectory mirrored = truth;
  for (StampedPose& pose : mirrored) pose.T_world_lidar.translation().z() *= -1;
  EXPECT_NEAR(alignment_of({truth, mirrored}, Alignment::se3).rotation.determinant(), 1, 1e-12);
}

TEST(Alignment, LeavesTheLeastSumOfSquares) {
  const Trajectory truth = test::random_walk(60, 5), other = test::random_walk(60, 6);
  const auto sum = [&](const Similarity& S) {
    double total = 0;
    const Trajectory moved = transform(other, S);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      total += (moved[i].T_world_lidar.translation() - truth[i].T_world_lidar.translation()).squaredNorm();
    }
    return total;
  };
  const Similarity best = alignment_of({truth, other}, Alignment::sim3);
  for (int axis = 0; axis < 6; ++axis) {
    const Pose nudge = exp(1e-4 * Vector6d::Unit(axis));
    const Similarity S{best.scale, nudge.linear() * best.rotation, nudge * best.translation};
    EXPECT_GT(sum(S), sum(best)) << axis;
  }
  EXPECT_GT(sum({best.scale * 1.0001, best.rotation, best.translation}), sum(best));
}

TEST(Alignment, RefusesPositionsOnALine) {
  const Pose T = test::some_pose();
  for (const Trajectory& line : {test::straight_line(50, 0.3), test::moved(test::straight_line(50, 0.3), T),
                                 test::straight_line(50, 0.0), test::random_walk(2, 1)}) {
    EXPECT_THROW(alignment_of({line, line}, Alignment::se3), Error);
    EXPECT_THROW(alignment_of({line, line}, Alignment::sim3), Error);
    EXPECT_NO_THROW(alignment_of({line, line}, Alignment::origin));
  }
}

TEST(Alignment, AcceptsALineWithAMillimetreOfWidth) {
  Trajectory line = test::straight_line(400, 0.25);
  for (std::size_t i = 0; i < line.size(); i += 2) line[i].T_world_lidar.translation().y() = 1e-3;
  const Similarity S = alignment_of({line, test::moved(line, test::some_pose())}, Alignment::se3);
  EXPECT_LT((S.rotation * test::some_pose().linear() - Eigen::Matrix3d::Identity()).norm(), 1e-4);
}

}  // namespace
}  // namespace tilth
