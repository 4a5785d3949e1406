#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include <tilth/evaluation/open_roll.hpp>

namespace tilth {
namespace {

constexpr double kLineLike = 0.1;
constexpr double kSure = std::numbers::pi / 180;  // [rad]

}  // namespace

std::optional<OpenRoll> open_roll(const MatchedPoses& aligned) {
  const double n = double(aligned.truth.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const StampedPose& pose : aligned.truth) mean += pose.T_world_lidar.translation() / n;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const StampedPose& pose : aligned.truth) {
    const Eigen::Vector3d d = pose.T_world_lidar.translation() - mean;
    covariance += d * d.transpose() / n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Vector3d line = eigen.eigenvectors().col(2);
  const double off_line = std::sqrt(std::max(0.0, eigen.eigenvalues()[0] + eigen.eigenvalues()[1]));
  if (off_line > kLineLike * std::sqrt(eigen.eigenvalues()[2])) return std::nullopt;
  double across = 0;
  for (std::size_t i = 0; i < aligned.truth.size(); ++i) {
    const Eigen::Vector3d error =
        aligned.estimate[i].T_world_lidar.translation() - aligned.truth[i].T_world_lidar.translation();
    across += error.cross(line).squaredNorm() / n;
  }
  const double angle = std::atan2(std::sqrt(across), off_line);
  if (angle < kSure) return std::nullopt;
  return OpenRoll{off_line, angle};
}

}  // namespace tilth
