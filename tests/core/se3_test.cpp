// Laws of SE(3) over a grid of tangents.
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/core/se3.hpp>

namespace tilth {
namespace {

std::vector<Vector6d> tangents() {
  std::vector<Vector6d> all;
  for (const double angle : {0.0, 1e-9, 1e-6, 1e-5, 2e-4, 1e-3, 0.1, 1.0, 2.0, 3.0, std::numbers::pi - 1e-7}) {
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-2, 1, 0.5), Eigen::Vector3d(0, 3, -4)}) {
      Vector6d xi;
      xi << angle * axis.normalized(), 0.3, -20.0, 7.0;
      all.push_back(xi);
    }
  }
  return all;
}

TEST(Se3, LogUndoesExp) {
  for (const Vector6d& xi : tangents()) EXPECT_LT((log(exp(xi)) - xi).norm(), 1e-8) << xi.transpose();
}

TEST(Se3, ExpIsARotationAndMatchesItsSeries) {
  for (const Vector6d& xi : tangents()) {
    const Pose T = exp(xi);
    EXPECT_LT((T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero(), term = Eigen::Matrix4d::Identity(), sum = term;
    A.topLeftCorner<3, 3>() = skew(xi.head<3>());
    A.topRightCorner<3, 1>() = xi.tail<3>();
    for (int i = 1; i < 60; ++i) sum += term = (term * A / i).eval();
    EXPECT_LT((T.matrix() - sum).norm(), 1e-9 * sum.norm()) << xi.transpose();
  }
}

TEST(Se3, AdjointMovesTangents) {
  for (const Vector6d& a : tangents()) {
    const Pose T = exp(a);
    const Vector6d xi = (Vector6d() << 0.01, -0.02, 0.03, 0.1, 0.2, -0.3).finished();
    EXPECT_LT(((T * exp(xi) * T.inverse()).matrix() - exp(adjoint(T) * xi).matrix()).norm(), 1e-9);
  }
}

TEST(Se3, InterpolationMeetsItsEnds) {
  for (const Vector6d& a : tangents()) {
    const Pose A = exp(a), B = A * exp((Vector6d() << 0.2, 0.1, -0.4, 1, 2, 3).finished());
    EXPECT_LT((interpolate(A, B, 0).matrix() - A.matrix()).norm(), 1e-9);
    EXPECT_LT((interpolate(A, B, 1).matrix() - B.matrix()).norm(), 1e-9);
    const Pose M = interpolate(A, B, 0.5);
    EXPECT_LT(((A.inverse() * M).matrix() - (M.inverse() * B).matrix()).norm(), 1e-9);
  }
}

TEST(Se3, RetractStaysOnTheManifoldForever) {
  Pose T = Pose::Identity();
  for (int i = 0; i < 100000; ++i) T = retract(T, (Vector6d() << 0.01, 0.02, -0.01, 0.1, 0, 0).finished());
  EXPECT_LT((T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace tilth
