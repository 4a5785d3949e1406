// What a pose inherits from the surfaces that it was registered to.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/odometry/pose_uncertainty.hpp>

namespace tilth {
namespace {

Matrix6d diagonal(double rotation, double translation) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(rotation), Eigen::Vector3d::Constant(translation);
  return covariance;
}

Pose at(double x, double yaw = 0) {
  Pose T = Pose::Identity();
  T.translation().x() = x;
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

const Matrix6d kOwn = diagonal(1e-6, 1e-4);

TEST(PoseUncertainty, IsItsOwnWhereTheSurfacesAreTheFirstOnes) {
  PoseUncertainty uncertainty;
  EXPECT_TRUE(uncertainty.add({0, at(0), Matrix6d::Zero(), 0}).isZero());
  for (int i = 1; i < 100; ++i) EXPECT_TRUE(uncertainty.add({0.1 * i, at(i), kOwn, 0}).isApprox(kOwn)) << i;
}

TEST(PoseUncertainty, GrowsByItsOwnOnceInTheAgeOfTheSurfaces) {
  PoseUncertainty uncertainty;
  Matrix6d covariance;
  for (int i = 0; i <= 1000; ++i) covariance = uncertainty.add({0.1 * i, at(0), kOwn, std::max(0.0, 0.1 * i - 10)});
  EXPECT_NEAR(covariance(3, 3) / kOwn(3, 3), 10, 1) << "100 s over surfaces that are 10 s old";
}

TEST(PoseUncertainty, GrowsFromPoseToPoseWhereSurfacesSayNothing) {
  PoseUncertainty uncertainty;
  Matrix6d covariance, ahead = Matrix6d::Zero();
  ahead(3, 3) = 1;
  for (int i = 0; i <= 400; ++i) covariance = uncertainty.add({0.1 * i, at(0.1 * i), kOwn, 0, ahead});
  EXPECT_NEAR(covariance(3, 3) / kOwn(3, 3), 401, 1e-6);
  EXPECT_NEAR(covariance(4, 4) / kOwn(4, 4), 1, 1e-6) << "held by the walls";
  const Matrix6d turned = uncertainty.add({40.1, at(40, M_PI / 2), kOwn, 0, Matrix6d::Zero()});
  EXPECT_TRUE(turned.isApprox(kOwn)) << "back at the first surfaces";
}

TEST(PoseUncertainty, ShrinksAmongOldSurfaces) {
  PoseUncertainty uncertainty;
  for (int i = 0; i <= 1000; ++i) uncertainty.add({0.1 * i, at(0), kOwn, std::max(0.0, 0.1 * i - 10)});
  EXPECT_TRUE(uncertainty.add({100.1, at(0), kOwn, 0}).isApprox(kOwn));
}

TEST(PoseUncertainty, AHeadingThatIsOffPutsThePoseAsideByTheWayFromThere) {
  PoseUncertainty uncertainty;
  uncertainty.add({0, at(0), Matrix6d::Zero(), 0});
  uncertainty.add({1, at(0), diagonal(1e-6, 0), 0});
  const Matrix6d ahead = uncertainty.add({2, at(20), Matrix6d::Zero(), 1});
  EXPECT_NEAR(std::sqrt(ahead(4, 4)), 20 * 1e-3, 1e-9);
  EXPECT_NEAR(ahead(3, 3), 0, 1e-12);
  const Matrix6d turned = uncertainty.add({2.1, at(20, M_PI / 2), Matrix6d::Zero(), 1});
  EXPECT_NEAR(std::sqrt(turned(3, 3)), 20 * 1e-3, 1e-9) << "along the axes of the LiDAR";
}

}  // namespace
}  // namespace tilth
