#include <cmath>

#include <Eigen/SVD>

#include <tilth/evaluation/pose_error.hpp>

namespace tilth {
namespace {

constexpr double kOrthonormal = 1e-12;  // scipy's bound, beneath which a matrix is taken as a rotation

bool is_orthonormal(const Eigen::Matrix3d& R) {
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kOrthonormal;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

Pose relative_pose(const Pose& a, const Pose& b) {
  Pose T = Pose::Identity();
  T.linear() = a.linear().transpose() * b.linear();
  T.translation() = a.linear().transpose() * (b.translation() - a.translation());
  return T;
}

double rotation_angle(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(is_orthonormal(R) ? R : nearest_rotation(R));
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

PoseErrors errors_of(const std::vector<Pose>& differences) {
  std::vector<double> translation, rotation, full;
  for (const Pose& E : differences) {
    translation.push_back(E.translation().norm());
    rotation.push_back(rotation_angle(E.linear()));
    full.push_back((E.matrix() - Eigen::Matrix4d::Identity()).norm());
  }
  return {metric_of(std::move(translation)), metric_of(std::move(rotation)), metric_of(std::move(full))};
}

}  // namespace tilth
