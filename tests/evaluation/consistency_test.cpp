// NEES by hand, and by the statistics of errors that are what they say.
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/consistency.hpp>

namespace tilth {
namespace {

Vector6d vector6(double rx, double ry, double rz, double tx, double ty, double tz) {
  return (Vector6d() << rx, ry, rz, tx, ty, tz).finished();
}

/// Poses along a curve, and estimates of which each but the first is off by its error: truth = estimate exp(error). The
/// estimates are in a frame of their own.
MatchedPoses off_by(const std::vector<Vector6d>& errors) {
  MatchedPoses matches;
  const Pose T_world_truth = exp(vector6(0.1, -0.2, 1, 5, -3, 1));
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double s = 0.1 * double(i);
    const Pose truth = exp(vector6(0.1 * s, 0, s, s, 0.5 * s, 0));
    matches.truth.push_back({s, truth});
    matches.estimate.push_back({s, T_world_truth * truth * exp(i == 0 ? Vector6d::Zero() : errors[i]).inverse()});
  }
  return matches;
}

TEST(Consistency, IsTheSumOfSquaresOverVariances) {
  const std::vector<Vector6d> errors{Vector6d::Zero(), vector6(0.01, 0, 0, 0, 0.2, 0), vector6(0, 0, 0, 0, 0, 0.3)};
  const std::vector<Vector6d> variances{Vector6d::Zero(), vector6(1e-4, 1, 1, 1, 0.01, 1),
                                        vector6(1, 1, 1, 1, 1, 0.09)};
  const Consistency found = consistency(off_by(errors), variances);
  EXPECT_EQ(found.poses, 2U);
  EXPECT_NEAR(found.mean_nees, ((1 + 4) + 1) / 2.0, 1e-6);
  EXPECT_DOUBLE_EQ(found.inside, 0.5);  // 5 lies within 1.24 .. 14.45, 1 does not
}

TEST(Consistency, LeavesOutPosesWithoutVariances) {
  const std::vector<Vector6d> errors(3, vector6(0, 0, 0, 0.1, 0, 0));
  const std::vector<Vector6d> variances{Vector6d::Zero(), vector6(1, 1, 1, 0, 1, 1), vector6(1, 1, 1, 0.01, 1, 1)};
  const Consistency found = consistency(off_by(errors), variances);
  EXPECT_EQ(found.poses, 1U);
  EXPECT_NEAR(found.mean_nees, 1.0, 1e-6);
}

TEST(Consistency, FindsHonestVariancesHonest) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Vector6d deviation = vector6(1e-3, 2e-3, 5e-4, 0.01, 0.02, 0.005);
  std::vector<Vector6d> errors;
  for (int i = 0; i < 4000; ++i) {
    errors.push_back(deviation);
    for (double& e : errors.back()) e *= normal(random);
  }
  const MatchedPoses matches = off_by(errors);
  std::vector<Vector6d> variances(errors.size(), deviation.array().square());
  variances.front().setZero();
  const Consistency honest = consistency(matches, variances);
  const auto bounds = mean_nees_bounds(errors.size());
  EXPECT_GT(honest.mean_nees, bounds[0]);
  EXPECT_LT(honest.mean_nees, bounds[1]);
  EXPECT_NEAR(honest.inside, 0.95, 0.015);
  std::vector<Vector6d> boasting(variances);
  for (Vector6d& v : boasting) v /= 4;
  EXPECT_NEAR(consistency(matches, boasting).mean_nees, 4 * honest.mean_nees, 1e-3);
}

TEST(Consistency, KnowsTheBoundsOfChiSquare) {
  const auto five = mean_nees_bounds(5);  // chi^2 with 30 degrees of freedom: 16.791 and 46.979
  EXPECT_NEAR(five[0], 16.791 / 5, 0.01);
  EXPECT_NEAR(five[1], 46.979 / 5, 0.01);
}

TEST(Consistency, RefusesAnotherNumberOfVariances) {
  EXPECT_THROW(consistency(off_by({Vector6d::Zero()}), {}), Error);
}

}  // namespace
}  // namespace tilth
