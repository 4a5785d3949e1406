#include <utility>

#include <tilth/odometry/mounted_odometry.hpp>

namespace tilth {
namespace {

MotionInScan seen_from(const Pose& T_cloud_sensor, MotionInScan motion) {
  const Matrix6d to_cloud = adjoint(T_cloud_sensor);
  motion.velocity = to_cloud * motion.velocity;
  motion.acceleration = to_cloud * motion.acceleration;
  for (Vector6d& knot : motion.vibration.knots) knot = to_cloud * knot;
  return motion;
}

AlignResult seen_from(const Pose& T_cloud_sensor, AlignResult alignment) {
  const Pose T_sensor_cloud = T_cloud_sensor.inverse();
  const Matrix6d to_cloud = adjoint(T_cloud_sensor), to_sensor = adjoint(T_sensor_cloud);
  alignment.T_target_source = T_cloud_sensor * alignment.T_target_source * T_sensor_cloud;
  alignment.covariance = to_cloud * alignment.covariance * to_cloud.transpose();
  alignment.information = to_sensor.transpose() * alignment.information * to_sensor;
  return alignment;
}

}  // namespace

MountedOdometry::MountedOdometry(std::unique_ptr<Odometry> odometry) : odometry_(std::move(odometry)) {
  odometry_->listen([this](std::string_view stage) { begin_stage(stage); });
}

OdometryResult MountedOdometry::register_scan(const Scan& scan) {
  if (!scan.T_cloud_sensor) return odometry_->register_scan(scan);
  T_cloud_sensor_ = *scan.T_cloud_sensor;
  const Pose T_sensor_cloud = T_cloud_sensor_.inverse();
  OdometryResult result = odometry_->register_scan({scan.stamp, transform(scan.cloud, T_sensor_cloud)});
  result.T_world_lidar = T_cloud_sensor_ * result.T_world_lidar * T_sensor_cloud;
  result.alignment = seen_from(T_cloud_sensor_, result.alignment);
  result.motion = seen_from(T_cloud_sensor_, result.motion);
  if (result.covariance) {
    const Matrix6d to_cloud = adjoint(T_cloud_sensor_);
    result.covariance = to_cloud * *result.covariance * to_cloud.transpose();
  }
  result.filtered = transform(result.filtered, T_cloud_sensor_);
  result.T_lidar_sensor = T_cloud_sensor_;
  return result;
}

PointCloud MountedOdometry::local_map() const {
  return transform(odometry_->local_map(), T_cloud_sensor_);
}

}  // namespace tilth
