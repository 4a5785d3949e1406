// Every residual against numeric derivatives, by one harness; the weights of the kernels; the inverse of covariances.
#include <random>

#include <gtest/gtest.h>

#include <tilth/registration/residual.hpp>
#include <tilth/registration/robust_kernel.hpp>

namespace tilth {
namespace {

template <Residual R>
double jacobian_gap(const R& r, const Pose& T) {
  double worst = 0;
  const auto J = jacobian(r, T);
  for (int i = 0; i < 6; ++i) {
    Vector6d d = Vector6d::Zero();
    d[i] = 1e-6;
    const auto numeric = ((r.residual(T * exp(d)) - r.residual(T * exp(-d))) / 2e-6).eval();
    worst = std::max(worst, (numeric - J.col(i)).norm());
  }
  return worst;
}

Eigen::Matrix3d some_covariance() {
  const Eigen::Matrix3d A = (Eigen::Matrix3d() << 0.3, 0.1, 0, -0.2, 0.5, 0.1, 0.05, 0, 0.2).finished();
  return A * A.transpose();
}

TEST(Residual, JacobiansMatchNumericOnes) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(-3, 3);
  const auto vector = [&] { return Eigen::Vector3d(u(rng), u(rng), u(rng)); };
  for (int i = 0; i < 50; ++i) {
    const Pose T = exp((Vector6d() << vector() / 3, 10 * vector()).finished());
    const Eigen::Vector3d p = vector(), q = vector(), n = vector().normalized();
    EXPECT_LT(jacobian_gap(PointToPoint{p, q}, T), 1e-6);
    EXPECT_LT(jacobian_gap(PointToPlane{p, q, n}, T), 1e-6);
    EXPECT_LT(jacobian_gap(PointToLine{p, q, n}, T), 1e-6);
    EXPECT_LT(jacobian_gap(DistributionToDistribution{p, q, inverse_of(some_covariance())}, T), 1e-6);
  }
}

TEST(Residual, InverseOfACovariance) {
  EXPECT_LT((inverse_of(some_covariance()) * some_covariance() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Residual, TermsOfGaussiansAreThoseOfTheirRoot) {
  const DistributionToDistribution pair{{1, 2, 3}, {2, 0, 1}, inverse_of(some_covariance())};
  const Pose T = exp((Vector6d() << 0.1, 0.2, -0.3, 1, 2, 3).finished());
  const ResidualTerms terms = terms_of(pair, T);
  const Eigen::Matrix3d D = pair.derivative();
  const Eigen::Vector3d e = pair.residual(T);
  EXPECT_NEAR(terms.squared, e.squaredNorm(), 1e-12 * e.squaredNorm());
  EXPECT_LT((terms.gradient - D.transpose() * e).norm(), 1e-12 * terms.gradient.norm());
  EXPECT_LT((terms.information - D.transpose() * D).norm(), 1e-12 * terms.information.norm());
}

TEST(RobustKernel, WeightsFallFromOne) {
  for (const Kernel kind : {Kernel::huber, Kernel::cauchy, Kernel::geman_mcclure}) {
    const RobustKernel kernel{kind, 2.0};
    EXPECT_EQ(kernel.weight(0), 1.0);
    EXPECT_LT(kernel.weight(100), kernel.weight(9));
    EXPECT_GT(kernel.weight(1e6), 0.0);
  }
  EXPECT_EQ((RobustKernel{Kernel::none, 1}.weight(1e6)), 1.0);
  EXPECT_DOUBLE_EQ((RobustKernel{Kernel::huber, 2}.weight(16)), 0.5);
  EXPECT_DOUBLE_EQ((RobustKernel{Kernel::cauchy, 2}.weight(16)), 0.2);
}

}  // namespace
}  // namespace tilth
