// The product {points, lines, planes, distributions} x {kernels} on pairs with a known transform.
#include <random>

#include <gtest/gtest.h>

#include <tilth/registration/align.hpp>
#include <tilth/registration/association.hpp>

namespace tilth {
namespace {

const Pose kTruth = exp((Vector6d() << 0.05, -0.04, 0.3, 0.5, -0.2, 0.1).finished());

std::vector<Eigen::Vector3d> scattered(std::size_t n) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> u(-5, 5);
  std::vector<Eigen::Vector3d> points(n);
  for (Eigen::Vector3d& p : points) p = {u(rng), u(rng), u(rng)};
  return points;
}

// Pairs that all agree at kTruth, but for the last `wrong`, which are a metre off.
template <class Make>
auto pairs_of(std::size_t n, std::size_t wrong, const Make& make) {
  std::vector<decltype(make(Eigen::Vector3d(), Eigen::Vector3d(), std::size_t{}))> pairs;
  for (const Eigen::Vector3d& q : scattered(n)) pairs.push_back(make(kTruth.inverse() * q, q, pairs.size()));
  for (std::size_t i = n - wrong; i < n; ++i) pairs[i].target += Eigen::Vector3d(1, 1, -1);
  return pairs;
}

const auto kPoint = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, std::size_t) { return PointToPoint{p, q}; };
const auto kPlane = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, std::size_t i) {
  return PointToPlane{p, q, Eigen::Vector3d::Unit(long(i % 3))};
};
const auto kLine = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, std::size_t i) {
  return PointToLine{p, q, Eigen::Vector3d::Unit(long(i % 3))};
};
const auto kDistribution = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, std::size_t i) {
  Eigen::Vector3d variance(1, 1, 1);
  variance[long(i % 3)] = 1e-4;
  return DistributionToDistribution{p, q, inverse_of(variance.asDiagonal())};
};

template <class Make>
double miss(const Make& make, AlignOptions options, std::size_t wrong) {
  const auto pairs = pairs_of(300, wrong, make);
  const AlignResult result = align(Pose::Identity(), options, [&](const Pose&) { return pairs; });
  EXPECT_TRUE(result.converged);
  return log(kTruth.inverse() * result.T_target_source).norm();
}

TEST(Align, FindsTheTransformFromEveryKindOfPair) {
  for (const Kernel kernel : {Kernel::none, Kernel::huber, Kernel::cauchy, Kernel::geman_mcclure}) {
    const AlignOptions options{.kernel = kernel, .kernel_width = 100};
    EXPECT_LT(miss(kPoint, options, 0), 1e-6);
    EXPECT_LT(miss(kPlane, options, 0), 1e-6);
    EXPECT_LT(miss(kLine, options, 0), 1e-6);
    EXPECT_LT(miss(kDistribution, options, 0), 1e-6);
  }
}

TEST(Align, KernelsOutvoteWrongPairs) {
  const double plain = miss(kPoint, {}, 30);
  EXPECT_GT(plain, 0.05);
  EXPECT_LT(miss(kPoint, {.kernel = Kernel::huber, .kernel_width = 0.05}, 30), 0.3 * plain);
  EXPECT_LT(miss(kPoint, {.kernel = Kernel::cauchy, .kernel_width = 0.05}, 30), 0.1 * plain);
}

TEST(Align, TooFewPairsKeepThePrediction) {
  const auto pairs = pairs_of(10, 0, kPoint);
  const Pose T = exp((Vector6d() << 0, 0, 0.1, 1, 2, 3).finished());
  const AlignResult result = align(T, AlignOptions{}, [&](const Pose&) { return pairs; });
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.T_target_source.matrix(), T.matrix());
}

TEST(Align, CountsTheDirectionsThatWallsLeaveOpen) {
  // A tunnel along x: two walls and a floor say nothing about x.
  const auto tunnel = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, std::size_t i) {
    return PointToPlane{p, q, Eigen::Vector3d::Unit(i % 2 == 0 ? 1 : 2)};
  };
  const auto open = pairs_of(300, 0, tunnel), closed = pairs_of(300, 0, kPlane);
  const Pose near = kTruth * exp((Vector6d() << 0, 0, 0, 0, 0.01, 0).finished());
  EXPECT_EQ(
      align(near, AlignOptions{.degeneracy_ratio = 1e-2}, [&](const Pose&) { return open; }).degenerate_directions, 1);
  const AlignResult result = align(near, AlignOptions{.degeneracy_ratio = 1e-2}, [&](const Pose&) { return closed; });
  EXPECT_EQ(result.degenerate_directions, 0);
  EXPECT_TRUE((result.covariance.diagonal().array() > 0).all());
}

TEST(Align, NormalEquationsAreThoseOfTheJacobians) {
  const Eigen::Matrix3d information = inverse_of(Eigen::Vector3d(0.1, 0.4, 0.2).asDiagonal());
  const auto pairs = pairs_of(40, 0.1, [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q, std::size_t) {
    return DistributionToDistribution{p, q, information};
  });
  const RobustKernel kernel{Kernel::geman_mcclure, 2};
  LinearSystem system;
  accumulate(system, std::span(pairs.data(), pairs.size()), kTruth, kernel);
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  for (const auto& pair : pairs) {
    const auto J = jacobian(pair, kTruth);
    const Eigen::Vector3d e = pair.residual(kTruth);
    H += kernel.weight(e.squaredNorm()) * J.transpose() * J;
    b += kernel.weight(e.squaredNorm()) * J.transpose() * e;
  }
  EXPECT_LT((system.H - H).norm(), 1e-12 * H.norm());
  EXPECT_LT((system.b - b).norm(), 1e-12 * b.norm());
  EXPECT_GT(b.norm(), 0);
}

struct Gaussian {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double variance = covariance(0, 0);
};

/// A map that finds as told.
template <class Find>
struct FoundBy {
  Find found;
  const Gaussian* find(const Eigen::Vector3d& p, const Eigen::Vector3d&, bool) const { return found(p); }
};

TEST(Association, PreCheckRefusesFarAndMissingTargets) {
  MatchedPatches<Gaussian> source{SurfacePatches(3, {.covariance = Eigen::Matrix3d::Identity()})};
  for (int i = 0; i < 3; ++i) source.patches[std::size_t(i)].mean.x() = i;
  const Gaussian target{Eigen::Vector3d(1.2, 0, 0), Eigen::Matrix3d::Identity()};
  const FoundBy map{[&](const Eigen::Vector3d& p) { return p.x() > 1.5 ? nullptr : &target; }};
  const auto pairs = associate_distributions(source, Pose::Identity(), map, {.max_distance = 0.5});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].source.x(), 1.0);
  EXPECT_EQ(associate_points(source, Pose::Identity(), map, {.max_distance = 0.5}).size(), 1u);
}

TEST(Association, LooksUpAnewOnlyWhatHasMoved) {
  MatchedPatches<Gaussian> source{{{.mean = Eigen::Vector3d::Zero()}, {.mean = 10 * Eigen::Vector3d::UnitX()}}};
  const Gaussian target{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  int asked = 0;
  const FoundBy map{[&](const Eigen::Vector3d&) {
    ++asked;
    return &target;
  }};
  const auto asked_at = [&](const Pose& T) {
    asked = 0;
    associate_points(source, T, map, {.max_distance = 20, .renew_distance = 0.02});
    return asked;
  };
  EXPECT_EQ(asked_at(Pose::Identity()), 2);
  EXPECT_EQ(asked_at(Pose(Eigen::Translation3d(0.01, 0, 0))), 0);
  const Pose T_turned(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(asked_at(T_turned), 1) << "the far one moves by 0.1 m, the near one does not";
}

TEST(Association, InformationIsRebuiltWithTheRotation) {
  MatchedPatches<Gaussian> source{{{.covariance = Eigen::Vector3d(4, 1, 1).asDiagonal()}}};
  const Gaussian target{Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 2, 3).asDiagonal()};
  const FoundBy map{[&](const Eigen::Vector3d&) { return &target; }};
  const Pose T(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  const auto pairs = associate_distributions(source, T, map, {.lambda = 0.5});
  EXPECT_LT((pairs[0].information.inverse().diagonal() - Eigen::Vector3d(1 + 1 + 1, 4 + 2 + 1, 1 + 3 + 1)).norm(),
            1e-9);
}

}  // namespace
}  // namespace tilth
