#include <tilth/evaluation/body_frame.hpp>

namespace tilth {
namespace {

constexpr double kOneDirection = 0.7;  // of the steps' length that must add up
constexpr double kLeastPath = 10 * kForwardStep;

}  // namespace

std::optional<Eigen::Vector3d> forward_direction(const Trajectory& trajectory) {
  if (trajectory.empty()) return std::nullopt;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double path = 0;
  Pose from = trajectory.front().T_world_lidar;
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d step = pose.T_world_lidar.translation() - from.translation();
    if (step.norm() < kForwardStep) continue;
    sum += from.linear().transpose() * step;
    path += step.norm();
    from = pose.T_world_lidar;
  }
  if (path < kLeastPath || sum.norm() < kOneDirection * path) return std::nullopt;
  return sum.normalized();
}

Trajectory in_frame_of(Trajectory trajectory, const Pose& T_a_b) {
  for (StampedPose& pose : trajectory) pose.T_world_lidar = T_a_b.inverse() * pose.T_world_lidar * T_a_b;
  return trajectory;
}

}  // namespace tilth
