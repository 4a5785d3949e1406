// An alignment by positions that lie on a line may turn the estimate about it, and says so.
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "made_trajectories.hpp"
#include <tilth/evaluation/evaluate.hpp>

namespace tilth {
namespace {

/// `line` with errors of its positions, rolled about x as a whole.
Trajectory noisy(Trajectory line, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, sigma);
  for (StampedPose& pose : line) {
    for (double& value : pose.T_world_lidar.translation()) value += noise(random);
  }
  return line;
}

Evaluation aligned(const Trajectory& truth, const Trajectory& estimate, Alignment align) {
  EvaluationOptions options;
  options.align = align;
  return evaluate(truth, estimate, options);
}

TEST(OpenRoll, IsSaidOfAStraightPath) {
  const Trajectory truth = noisy(test::straight_line(300, 0.3), 0.01, 1);
  const Trajectory estimate = noisy(test::straight_line(300, 0.3), 0.01, 2);
  for (const Alignment align : {Alignment::se3, Alignment::sim3}) {
    const Evaluation evaluation = aligned(truth, estimate, align);
    ASSERT_TRUE(evaluation.open_roll);
    EXPECT_NEAR(evaluation.open_roll->off_line, 0.01 * std::numbers::sqrt2, 0.002);
    EXPECT_GT(evaluation.open_roll->angle, 0.5);
    // What it warns of: no pose is turned in truth, yet the alignment turns all of them.
    EXPECT_GT(evaluation.ape.rotation.rmse, 0.1);
  }
  EXPECT_FALSE(aligned(truth, estimate, Alignment::origin).open_roll);
  EXPECT_FALSE(aligned(truth, estimate, Alignment::none).open_roll);
}

TEST(OpenRoll, BoundsTheTurnThatItWarnsOf) {
  int inside = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Trajectory truth = noisy(test::straight_line(300, 0.3), 0.05, 2 * seed + 1);
    const Evaluation evaluation = aligned(truth, noisy(truth, 0.01, 2 * seed + 2), Alignment::se3);
    ASSERT_TRUE(evaluation.open_roll);
    if (evaluation.ape.rotation.rmse < evaluation.open_roll->angle) ++inside;
  }
  EXPECT_GE(inside, 38);
}

TEST(OpenRoll, IsSureWhereThePathTurnsOrTheErrorsAreSmall) {
  const Trajectory walk = test::random_walk(300, 4);
  EXPECT_FALSE(aligned(walk, noisy(walk, 0.05, 5), Alignment::se3).open_roll);
  const Trajectory line = noisy(test::straight_line(300, 0.3), 0.05, 6);
  EXPECT_FALSE(aligned(line, noisy(line, 1e-4, 7), Alignment::se3).open_roll);
}

}  // namespace
}  // namespace tilth
