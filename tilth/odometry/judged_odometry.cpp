#include <algorithm>
#include <utility>

#include <tilth/odometry/judged_odometry.hpp>

namespace tilth {

Matrix6d drift_after(double time) {
  constexpr double kAcceleration = 3.0, kSpeed = 10.0;       // [m/s^2] [m/s]
  constexpr double kAngularAcceleration = 3.0, kTurn = 1.0;  // [rad/s^2] [rad/s]
  const double half_square = 0.5 * time * time;
  const double translation = std::min(kAcceleration * half_square, kSpeed * time);
  const double rotation = std::min(kAngularAcceleration * half_square, kTurn * time);
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(rotation), Eigen::Vector3d::Constant(translation);
  return sigma.cwiseAbs2().asDiagonal();
}

JudgedOdometry::JudgedOdometry(std::unique_ptr<Odometry> odometry) : odometry_(std::move(odometry)) {
  odometry_->listen([this](std::string_view stage) { begin_stage(stage); });
}

OdometryResult JudgedOdometry::register_scan(const Scan& scan) {
  OdometryResult result = odometry_->register_scan(scan);
  result.track = judge_.judge(result);
  if (judge_.unknown_for() > 0)
    result.covariance = result.covariance.value_or(result.alignment.covariance) + drift_after(judge_.unknown_for());
  return result;
}

}  // namespace tilth
