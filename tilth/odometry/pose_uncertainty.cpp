#include <algorithm>

#include <tilth/odometry/pose_uncertainty.hpp>

namespace tilth {
namespace {

constexpr double kStep = 0.5;  // [s] between the instants that are kept

}  // namespace

// docs/method.md, 17.
Matrix6d PoseUncertainty::add(const RegisteredPose& pose) {
  const Matrix6d to_map = adjoint(pose.T_map_lidar), to_lidar = adjoint(pose.T_map_lidar.inverse());
  if (instants_.empty()) instants_.push_back({pose.time, Matrix6d::Zero()});
  const Matrix6d lost = to_map * pose.dead_reckoned * to_lidar, kept = Matrix6d::Identity() - lost;
  const Matrix6d in_map = kept * covariance_at(pose.surfaces_seen_at) * kept.transpose() +
                          lost * last_covariance_in_map_ * lost.transpose() +
                          to_map * pose.covariance * to_map.transpose();
  if (pose.time - instants_.back().time >= kStep) instants_.push_back({pose.time, in_map});
  last_covariance_in_map_ = in_map;
  return to_lidar * in_map * to_lidar.transpose();
}

Matrix6d PoseUncertainty::covariance_at(double time) const {
  const auto after = std::upper_bound(instants_.begin(), instants_.end(), time,
                                      [](double t, const Instant& instant) { return t < instant.time; });
  if (after == instants_.begin()) return instants_.front().covariance_in_map;
  if (after == instants_.end()) return instants_.back().covariance_in_map;
  const auto before = after - 1;
  const double ratio = (time - before->time) / (after->time - before->time);
  return before->covariance_in_map + ratio * (after->covariance_in_map - before->covariance_in_map);
}

}  // namespace tilth
