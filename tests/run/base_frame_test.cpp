// Poses of base_link: lists as people write them, there and back, covariances by the adjoint against small motions.
#include <io/expect_error.hpp>
#include <iomanip>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

#include <tilth/run/base_frame.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double gap(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

TEST(Mount, IsReadAsUrdfTurnsIt) {
  const Pose T = parse_mount("0.1,-0.2,0.3,10,-20,90");
  const double r = 10 * kDegree, p = -20 * kDegree;
  EXPECT_LT((T.translation() - Eigen::Vector3d(0.1, -0.2, 0.3)).norm(), 1e-15);
  // The third column of Rz(90) Ry(p) Rx(r), multiplied out by hand.
  const Eigen::Vector3d z(std::sin(r), std::sin(p) * std::cos(r), std::cos(p) * std::cos(r));
  EXPECT_LT((T.linear().col(2) - z).norm(), 1e-12);
  EXPECT_LT(gap(parse_mount("1,2,3,0,0,0"), Pose(Eigen::Translation3d(1, 2, 3))), 1e-15);
}

TEST(Mount, IsReadAsTfHasIt) {
  const Pose T = parse_mount("0.1,-0.2,0.3,10,-20,90");
  std::ostringstream text;
  text << std::setprecision(9);
  for (const double number : mount_numbers(T)) text << (text.str().empty() ? "" : ",") << number;
  EXPECT_LT(gap(parse_mount(text.str()), T), 1e-8);
}

TEST(Mount, RefusesNamingTheField) {
  const auto refused = [](const std::string& text, const std::string& why) {
    expect_error([&] { parse_mount(text); }, {"base_from_lidar", why});
  };
  refused("1,2,3,0,0", "yaw is missing");
  refused("", "y is missing");
  refused("1,2,3,0,5deg,0", "pitch is \"5deg\"");
  refused("1,2,,0,0,0", "z is \"\"");
  refused("nan,2,3,0,0,0", "x is \"nan\"");
  refused("1,2,3,0,0,0,0", "length 1");
  refused("300,0,800,0,0,0", "x is more than 100 m");
  refused("1,2,3,4,5,6,7,8", "8 numbers");
}

TEST(BaseFrame, ThereAndBack) {
  const Pose T_base_lidar = parse_mount("0.4,-0.1,0.6,3,-8,170");
  Trajectory poses;
  for (int i = 0; i < 5; ++i) poses.push_back({double(i), exp(0.3 * i * Vector6d{0.1, -0.2, 1, 1, 2, -0.5})});
  const Trajectory base = poses_of_base(poses, T_base_lidar), back = poses_of_lidar(base, T_base_lidar);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT(gap(base[i].T_world_lidar * T_base_lidar, poses[i].T_world_lidar), 1e-12);
    EXPECT_LT(gap(back[i].T_world_lidar, poses[i].T_world_lidar), 1e-12);
    EXPECT_EQ(base[i].stamp, poses[i].stamp);
  }
  EXPECT_EQ(gap(poses_of_base(poses, std::nullopt)[3].T_world_lidar, poses[3].T_world_lidar), 0.0);
}

TEST(BaseFrame, CovarianceIsThatOfTheMovedPose) {
  const Pose T_base_lidar = parse_mount("0.4,-0.1,0.6,3,-8,170");
  const Pose T_world_lidar = exp(Vector6d{0.1, -0.2, 1, 1, 2, -0.5});
  Matrix6d J;  // how a small motion of the LiDAR, in its frame, moves the base, in its own
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    const Pose nudged = T_world_lidar * exp(kStep * Vector6d::Unit(i));
    J.col(i) = log(pose_of_base(T_world_lidar, T_base_lidar).inverse() * pose_of_base(nudged, T_base_lidar)) / kStep;
  }
  const Matrix6d A = Matrix6d::Random(), covariance = A * A.transpose();
  EXPECT_LT((covariance_of_base(covariance, T_base_lidar) - J * covariance * J.transpose()).norm(), 1e-4);
  EXPECT_EQ(covariance_of_base(covariance, std::nullopt), covariance);
}

}  // namespace
}  // namespace tilth
