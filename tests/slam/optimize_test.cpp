// The pose graph against problems solved by hand, and against its own cost by numeric differentiation.
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/slam/optimize.hpp>

namespace tilth {
namespace {

Pose at(double x, double y, double yaw = 0) {
  return Eigen::Translation3d(x, y, 0) * Pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

GraphOptions without_kernel() {
  return {.kernel_width = 1e3};
}

/// A drive once round a square of 4 m, a pose a metre, as truth says.
std::vector<Pose> square() {
  std::vector<Pose> poses{at(0, 0)};
  for (int i = 1; i <= 16; ++i)
    poses.push_back(normalized(poses.back() * at(1, 0, i % 4 == 0 ? std::numbers::pi / 2 : 0)));
  return poses;
}

/// Its graph with an odometry that is off by `error` in every step; poses as odometry has them.
PoseGraph drifted(const std::vector<Pose>& truth, const Vector6d& error) {
  PoseGraph graph{.poses = {truth[0]}};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Pose T = retract(truth[i - 1].inverse() * truth[i], error);
    graph.constraints.push_back({i - 1, i, T, Matrix6d::Identity() * 1e2, false});
    graph.poses.push_back(normalized(graph.poses.back() * T));
  }
  return graph;
}

Constraint true_closure(const std::vector<Pose>& truth, std::size_t from, std::size_t to) {
  return {from, to, truth[from].inverse() * truth[to], Matrix6d::Identity() * 1e4, true};
}

double worst_error(const std::vector<Pose>& poses, const std::vector<Pose>& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    worst = std::max(worst, (poses[i].translation() - truth[i].translation()).norm());
  return worst;
}

TEST(OptimizePoseGraph, SharesAContradictionAsSolvedByHand) {
  // 1 m, 1 m, and 2.3 m for both: each of the three equally believed takes a third of the 0.3 m.
  PoseGraph graph{.poses = {at(0, 0), at(1, 0), at(2, 0)}};
  graph.constraints = {{0, 1, at(1, 0), Matrix6d::Identity(), false},
                       {1, 2, at(1, 0), Matrix6d::Identity(), false},
                       {0, 2, at(2.3, 0), Matrix6d::Identity(), true}};
  const OptimizedGraph optimized = optimize(graph, without_kernel());
  EXPECT_TRUE(optimized.converged);
  EXPECT_TRUE(optimized.poses[0].isApprox(at(0, 0), 1e-12));
  EXPECT_TRUE(optimized.poses[1].isApprox(at(1.1, 0), 1e-5));
  EXPECT_TRUE(optimized.poses[2].isApprox(at(2.2, 0), 1e-5));
}

TEST(OptimizePoseGraph, WeighsByInformation) {
  // (a - 1)^2 + (a - 2)^2 * 3 is least at 1.75; rotations likewise.
  PoseGraph graph{.poses = {at(0, 0), at(1, 0)}};
  graph.constraints = {{0, 1, at(1, 0, 0.0), Matrix6d::Identity(), false},
                       {0, 1, at(2, 0, 0.04), 3 * Matrix6d::Identity(), false}};
  const Pose pose = optimize(graph, without_kernel()).poses[1];
  EXPECT_NEAR(pose.translation().x(), 1.75, 2e-3);
  EXPECT_NEAR(angle_of(pose), 0.03, 1e-3);
}

TEST(OptimizePoseGraph, LeavesAloneWhatAConstraintHasNoInformationOn) {
  PoseGraph graph{.poses = {at(0, 0), at(1, 0)}};
  Matrix6d across = Matrix6d::Zero();
  across(4, 4) = 1e6;  // y only
  graph.constraints = {{0, 1, at(1, 0), Matrix6d::Identity(), false}, {0, 1, at(7, 0.5), across, true}};
  const Pose pose = optimize(graph, without_kernel()).poses[1];
  EXPECT_NEAR(pose.translation().x(), 1.0, 1e-6);
  EXPECT_NEAR(pose.translation().y(), 0.5, 1e-3);
}

TEST(OptimizePoseGraph, ClosesADriftedSquare) {
  const std::vector<Pose> truth = square();
  Vector6d drift;
  drift << 0.001, -0.002, 0.01, 0.02, 0.01, -0.01;
  PoseGraph graph = drifted(truth, drift);
  ASSERT_GT(worst_error(graph.poses, truth), 0.4);
  graph.constraints.push_back(true_closure(truth, 0, 16));
  const std::vector<Pose> poses = optimize(graph, without_kernel()).poses;
  EXPECT_LT((poses[16].translation() - truth[16].translation()).norm(), 0.02);
  EXPECT_LT(worst_error(poses, truth), 0.15);
}

TEST(OptimizePoseGraph, StandsStillByNumericDifferentiationOfItsCost) {
  const std::vector<Pose> truth = square();
  Vector6d drift;
  drift << 0.002, 0.001, -0.01, 0.03, -0.01, 0.02;
  PoseGraph graph = drifted(truth, drift);
  graph.constraints.push_back(true_closure(truth, 2, 15));
  Matrix6d& information = graph.constraints.back().information;
  information(0, 4) = information(4, 0) = 3e3;
  const auto cost = [&](const std::vector<Pose>& poses) {
    double sum = 0;
    for (const Constraint& c : graph.constraints) sum += squared_error(c, poses[c.from], poses[c.to]);
    return sum;
  };
  const auto slope = [&](std::vector<Pose> poses, std::size_t pose, int axis) {
    constexpr double kStep = 1e-5;
    const Pose middle = poses[pose];
    poses[pose] = retract(middle, Vector6d::Unit(axis) * kStep);
    const double above = cost(poses);
    poses[pose] = retract(middle, -Vector6d::Unit(axis) * kStep);
    return (above - cost(poses)) / (2 * kStep);
  };
  const std::vector<Pose> optimized = optimize(graph, without_kernel()).poses;
  EXPECT_LT(cost(optimized), 0.1 * cost(graph.poses));
  double steepest = 0;
  for (int axis = 0; axis < 6; ++axis) steepest = std::max(steepest, std::abs(slope(graph.poses, 15, axis)));
  for (std::size_t i = 1; i < optimized.size(); ++i)
    for (int axis = 0; axis < 6; ++axis) EXPECT_LT(std::abs(slope(optimized, i, axis)), 1e-3 * steepest) << i;
}

TEST(OptimizePoseGraph, KernelRejectsAPlantedFalseClosure) {
  const std::vector<Pose> truth = square();
  Vector6d drift = Vector6d::Zero();
  drift[2] = 0.01, drift[3] = 0.02;
  PoseGraph graph = drifted(truth, drift);
  for (const std::size_t i : {0, 1, 2}) graph.constraints.push_back(true_closure(truth, i, 14 + i));
  const double without = worst_error(optimize(graph, {}).poses, truth);
  Constraint planted = true_closure(truth, 4, 12);
  planted.T_from_to.translation() += Eigen::Vector3d(2, 1, 0);
  graph.constraints.push_back(planted);
  EXPECT_LT(worst_error(optimize(graph, {}).poses, truth), without + 0.05);
  EXPECT_GT(worst_error(optimize(graph, without_kernel()).poses, truth), 0.5);
}

TEST(OptimizePoseGraph, GivesTheSameBitsEveryTime) {
  const std::vector<Pose> truth = square();
  PoseGraph graph = drifted(truth, Vector6d::Constant(0.005));
  graph.constraints.push_back(true_closure(truth, 0, 16));
  const std::vector<Pose> once = optimize(graph, {}).poses, again = optimize(graph, {}).poses;
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].matrix(), again[i].matrix());
}

TEST(OptimizePoseGraph, RefusesConstraintsOfPosesItDoesNotHave) {
  PoseGraph graph{.poses = {at(0, 0), at(1, 0)}};
  graph.constraints = {{0, 2, at(1, 0), Matrix6d::Identity(), false}};
  EXPECT_THROW(optimize(graph, {}), Error);
  graph.constraints = {{1, 1, at(1, 0), Matrix6d::Identity(), false}};
  EXPECT_THROW(optimize(graph, {}), Error);
}

TEST(OptimizePoseGraph, LeavesAGraphWithoutConstraintsAsItIs) {
  EXPECT_TRUE(optimize({}, {}).poses.empty());
  EXPECT_EQ(optimize({.poses = {at(3, 4)}}, {}).poses[0].matrix(), at(3, 4).matrix());
}

}  // namespace
}  // namespace tilth
