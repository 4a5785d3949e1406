// Symmetric matrices as six numbers, against whole ones.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <tilth/core/symmetric3.hpp>

namespace tilth {
namespace {

const Eigen::Matrix3d kMatrix = (Eigen::Matrix3d() << 4, 0.1, -0.2, 0.1, 3, 0.7, -0.2, 0.7, 2).finished();

TEST(Symmetric3, IsTheMatrixItIsMadeOf) {
  EXPECT_EQ(Symmetric3d::of(kMatrix).matrix(), kMatrix);
  EXPECT_EQ((2.0 * Symmetric3d::of(kMatrix) / 4.0).matrix(), 0.5 * kMatrix);
}

TEST(Symmetric3, HasTheVarianceAlongAVector) {
  const Eigen::Vector3d n(0.6, -0.3, 0.2);
  EXPECT_NEAR(Symmetric3d::of(kMatrix).along(n), n.dot(kMatrix * n), 1e-12);
}

TEST(Symmetric3, AddsProductsUp) {
  const Eigen::Vector3d a(1, 2, 3);
  Symmetric3d sum = Symmetric3d::product(a, 2 * a);
  sum += Symmetric3d::of(kMatrix);
  EXPECT_TRUE(sum.matrix().isApprox(2 * a * a.transpose() + kMatrix));
  EXPECT_TRUE((sum - Symmetric3d::of(kMatrix)).matrix().isApprox(2 * a * a.transpose()));
}

TEST(Symmetric3, TurnsWithItsFrame) {
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.3, -0.2, 0.8, 0.1).normalized().toRotationMatrix();
  EXPECT_TRUE(rotated(R, kMatrix).matrix().isApprox(R * kMatrix * R.transpose()));
}

}  // namespace
}  // namespace tilth
