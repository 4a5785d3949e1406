#include <utility>

#include <tilth/odometry/continued_odometry.hpp>

namespace tilth {

ContinuedOdometry::ContinuedOdometry(std::unique_ptr<Odometry> odometry, const Pose& T_world_start)
    : odometry_(std::move(odometry)), T_world_start_(T_world_start) {
  odometry_->listen([this](std::string_view stage) { begin_stage(stage); });
}

OdometryResult ContinuedOdometry::register_scan(const Scan& scan) {
  OdometryResult result = odometry_->register_scan(scan);
  result.T_world_lidar = T_world_start_ * result.T_world_lidar;
  result.alignment.T_target_source = T_world_start_ * result.alignment.T_target_source;
  return result;
}

PointCloud ContinuedOdometry::local_map() const {
  return transform(odometry_->local_map(), T_world_start_);
}

}  // namespace tilth
