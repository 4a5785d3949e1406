// APE, RPE and the KITTI metric: laws and hand-made numbers.
#include <numbers>

#include <gtest/gtest.h>

#include "made_trajectories.hpp"
#include <tilth/core/error.hpp>
#include <tilth/evaluation/evaluate.hpp>

namespace tilth {
namespace {

Pose turned(double angle, const Eigen::Vector3d& axis) {
  return Pose(Eigen::AngleAxisd(angle, axis.normalized()));
}

TEST(RotationAngle, OverTheWholeRange) {
  for (const double angle : {0.0, 1e-14, 1e-9, 1e-4, 0.5, 2.0, 3.0, std::numbers::pi - 1e-9, std::numbers::pi}) {
    EXPECT_NEAR(rotation_angle(turned(angle, {1, -2, 3}).linear()), angle, 1e-15 + 1e-15 * angle) << angle;
  }
}

TEST(RotationAngle, OfARoundedMatrixIsThatOfTheNearestRotation) {
  const Eigen::Matrix3d R = turned(0.8, {1, -2, 3}).linear();
  const Eigen::Matrix3d stretch = Eigen::Vector3d(1 + 1e-4, 1 - 2e-4, 1 + 3e-4).asDiagonal();
  EXPECT_NEAR(rotation_angle(R * stretch), 0.8, 1e-12);
}

TEST(Ape, OfEqualTrajectoriesIsZero) {
  const Trajectory walk = test::random_walk(50, 1);
  const PoseErrors errors = ape({walk, walk});
  EXPECT_EQ(errors.translation.max, 0);
  EXPECT_LT(errors.rotation.max, 1e-15);
  EXPECT_LT(errors.full.max, 1e-14);
}

TEST(Ape, HandMadeNumbers) {
  const Trajectory truth = test::straight_line(3, 1);
  Trajectory estimate = truth;
  estimate[1].T_world_lidar = Eigen::Translation3d(3, 4, 0) * truth[1].T_world_lidar;  // 5 m off
  estimate[2].T_world_lidar = truth[2].T_world_lidar * turned(0.5, {0, 0, 1});
  const PoseErrors errors = ape({truth, estimate});
  EXPECT_EQ(errors.translation.errors, (std::vector<double>{0, 5, 0}));
  EXPECT_NEAR(errors.rotation.errors[2], 0.5, 1e-15);
  EXPECT_NEAR(errors.full.errors[1], 5, 1e-15);
  EXPECT_NEAR(errors.full.errors[2], std::sqrt(4 * (1 - std::cos(0.5))), 1e-15);  // |R - I| = 2 sqrt(1 - cos)
}

TEST(Rpe, DoesNotDependOnTheWorldFrame) {
  const Trajectory truth = test::random_walk(80, 1), estimate = test::random_walk(80, 2);
  const RpeOptions options{.pairs = {.delta = 1, .unit = DeltaUnit::meters}};
  const PoseErrors here = rpe({truth, estimate}, options);
  const PoseErrors there = rpe({truth, test::moved(estimate, test::some_pose())}, options);
  EXPECT_NEAR(here.translation.rmse, there.translation.rmse, 1e-12);
  EXPECT_NEAR(here.rotation.rmse, there.rotation.rmse, 1e-12);
  EXPECT_NEAR(here.full.rmse, there.full.rmse, 1e-12);
}

TEST(Rpe, HandMadeNumbers) {
  const Trajectory truth = test::straight_line(5, 1);
  Trajectory estimate = test::straight_line(5, 1.1);
  for (std::size_t i = 0; i < 5; ++i) estimate[i].T_world_lidar.rotate(turned(0.02 * double(i), {1, 0, 0}).linear());
  const PoseErrors two = rpe({truth, estimate}, {.pairs = {.delta = 2}});
  ASSERT_EQ(two.translation.errors.size(), 2u);
  EXPECT_NEAR(two.translation.max, 0.2, 1e-15);
  EXPECT_NEAR(two.rotation.min, 0.04, 1e-15);
}

TEST(Rpe, PairsComeFromTheEstimateUnlessAskedElse) {
  const Trajectory truth = test::straight_line(9, 1), estimate = test::straight_line(9, 2);
  RpeOptions options{.pairs = {.delta = 2, .unit = DeltaUnit::meters}};
  EXPECT_EQ(rpe({truth, estimate}, options).translation.errors.size(), 8u);
  options.pairs_from_truth = true;
  EXPECT_EQ(rpe({truth, estimate}, options).translation.errors.size(), 4u);
}

TEST(Kitti, ScaleErrorIsTheShareOfTheLength) {
  const MatchedPoses matches{test::straight_line(301, 1), test::straight_line(301, 1.01)};
  const KittiMetric metric = kitti_metric(matches);
  // 20 segments of 100 m begin at 0, 10 ... 190 (one that ends at 301 m would be needed for 200), 10 of 200 m.
  ASSERT_EQ(metric.by_length.size(), 2u);
  EXPECT_EQ(metric.segments.size(), 30u);
  EXPECT_NEAR(metric.by_length[0].translation, 0.01 * 101 / 100, 1e-12);  // ends at the first pose beyond 100 m
  EXPECT_NEAR(metric.by_length[1].translation, 0.01 * 201 / 200, 1e-12);
  EXPECT_NEAR(metric.translation, (20 * 0.0101 + 10 * 0.01005) / 30, 1e-12);
  EXPECT_NEAR(metric.rotation, 0, 1e-15);
}

TEST(Kitti, TurningErrorIsPerMetre) {
  Trajectory estimate = test::straight_line(150, 1);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_world_lidar.rotate(turned(1e-3 * double(i), {1, 0, 0}).linear());
  }
  EXPECT_NEAR(kitti_metric({test::straight_line(150, 1), estimate}).rotation, 1e-3 * 101 / 100, 1e-12);
}

TEST(Kitti, RefusesAShortPath) {
  const Trajectory line = test::straight_line(100, 1);
  EXPECT_THROW(kitti_metric({line, line}), Error);
}

TEST(Evaluate, AlignedEqualMotionHasNoError) {
  const Trajectory truth = test::random_walk(100, 3), estimate = test::moved(truth, test::some_pose());
  for (const Alignment align : {Alignment::origin, Alignment::se3, Alignment::sim3}) {
    EvaluationOptions options;
    options.align = align;
    const Evaluation evaluation = evaluate(truth, estimate, options);
    EXPECT_LT(evaluation.ape.translation.max, 1e-11);
    EXPECT_LT(evaluation.rpe.full.max, 1e-11);
    EXPECT_NEAR(evaluation.start_distance, test::some_pose().translation().norm(), 1e-12);
    EXPECT_NEAR(evaluation.start_angle, angle_of(test::some_pose()), 1e-12);
  }
  EXPECT_GT(evaluate(truth, estimate, {}).ape.translation.min, 1);
}

TEST(Evaluate, NeedsTwoMatches) {
  const Trajectory truth = test::straight_line(5, 1);
  EXPECT_THROW(evaluate(truth, {truth[2]}, {}), Error);
  EXPECT_THROW(evaluate(truth, test::shifted(truth, 0.5), {}), Error);
  EXPECT_EQ(evaluate(truth, {truth[2], truth[4]}, {}).matches.truth.size(), 2u);
}

TEST(Evaluate, ByIndexRefusesWhatNeedsStamps) {
  const Trajectory truth = test::straight_line(5, 1), estimate = test::shifted(truth, 100);
  EXPECT_EQ(evaluate_by_index(truth, estimate, {}).ape.translation.max, 0);
  EvaluationOptions seconds, interpolated;
  seconds.rpe.pairs.unit = DeltaUnit::seconds;
  interpolated.association.interpolate = true;
  EXPECT_THROW(evaluate_by_index(truth, estimate, seconds), Error);
  EXPECT_THROW(evaluate_by_index(truth, estimate, interpolated), Error);
}

}  // namespace
}  // namespace tilth
