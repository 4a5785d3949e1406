// Least eigenvalues against Eigen's iterative solver, over shapes from balls to needles.
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <tilth/core/symmetric_eigen.hpp>

namespace tilth {
namespace {

Eigen::Matrix3d covariance_of(const Eigen::Vector3d& variances, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  const double w = normal(rng), x = normal(rng), y = normal(rng), z = normal(rng);
  const Eigen::Matrix3d R = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  const Eigen::Matrix3d C = R * variances.asDiagonal() * R.transpose();
  return 0.5 * (C + C.transpose());
}

TEST(SymmetricEigen, AgreesWithAnIterativeSolver) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> exponent(-4, 0);
  for (int i = 0; i < 20000; ++i) {
    const double a = exponent(rng), b = exponent(rng), c = exponent(rng);
    const Eigen::Matrix3d C = covariance_of({std::pow(10, a), std::pow(10, b), std::pow(10, c)}, rng);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> exact(C);
    const Eigen::Vector3d found = eigenvalues(Symmetric3d::of(C));
    const double most = exact.eigenvalues()[2], gap = exact.eigenvalues()[1] - exact.eigenvalues()[0];
    EXPECT_LT((found - exact.eigenvalues()).norm(), 1e-5 * most);
    EXPECT_NEAR(found[0], exact.eigenvalues()[0], 1e-6 * exact.eigenvalues()[0] + 1e-12 * most);
    if (gap < 1e-2 * exact.eigenvalues()[1]) continue;  // nearly two directions of least spread
    const Eigen::Vector3d direction = smallest_eigenvector(Symmetric3d::of(C), found[0]);
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    EXPECT_GT(std::abs(direction.dot(exact.eigenvectors().col(0))), 1 - 1e-6);
  }
}

TEST(SymmetricEigen, OfPlanesLinesBallsAndPoints) {
  std::mt19937 rng(2);
  for (const Eigen::Vector3d& variances :
       {Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, 0),
        Eigen::Vector3d(1e-9, 2e-3, 5e-3), Eigen::Vector3d(3, 3, 5)}) {
    const Eigen::Matrix3d C = covariance_of(variances, rng);
    const Eigen::Vector3d found = eigenvalues(Symmetric3d::of(C)),
                          direction = smallest_eigenvector(Symmetric3d::of(C), found[0]);
    EXPECT_LT((found - variances).norm(), 1e-4 * (1e-9 + variances.norm()));  // a triple root is ill-conditioned
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    EXPECT_LT((C * direction - found[0] * direction).norm(), 1e-4 * (1e-9 + variances.norm()));
  }
}

}  // namespace
}  // namespace tilth
