#include <numbers>

#include <Eigen/LU>

#include <tilth/localization/map_tracker.hpp>

namespace tilth {

void MapTracker::move(const Pose& T_last_now, const Matrix6d& covariance) {
  const double path = T_last_now.translation().norm() + 0.05 * angle_of(T_last_now);
  const double turn_noise = options_.turn_noise * std::numbers::pi / 180;
  const Matrix6d to_now = adjoint(T_last_now.inverse());
  covariance_ = to_now * covariance_ * to_now.transpose() + options_.covariance_scale * covariance;
  covariance_.diagonal().head<3>().array() += turn_noise * turn_noise * path;
  covariance_.diagonal().tail<3>().array() += options_.noise * options_.noise * path;
  T_map_lidar_ = normalized(T_map_lidar_ * T_last_now);
}

bool MapTracker::correct(const Pose& T_map_lidar, const Matrix6d& information) {
  const Vector6d innovation = log(T_map_lidar_.inverse() * T_map_lidar);
  // The gain P (P + I^-1)^-1 = (1 + P I)^-1 P I, which also holds where the information is none along some directions.
  const Matrix6d told = covariance_ * information;
  const Eigen::PartialPivLU<Matrix6d> solver(Matrix6d::Identity() + told);
  const Vector6d expected = information * solver.solve(innovation);  // (P + I^-1)^-1 e
  if (innovation.dot(expected) > options_.max_squared_error) return false;
  T_map_lidar_ = retract(T_map_lidar_, solver.solve(told * innovation));
  const Matrix6d covariance = solver.solve(covariance_);
  covariance_ = 0.5 * (covariance + covariance.transpose());
  return true;
}

}  // namespace tilth
