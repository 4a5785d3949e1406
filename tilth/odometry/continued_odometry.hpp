// A pipeline that begins somewhere else than at the origin of the world: its first pose is given, all others follow it.
#pragma once

#include <memory>

#include <tilth/odometry/odometry.hpp>

namespace tilth {

class ContinuedOdometry : public Odometry {
 public:
  /// `odometry`, whose own world is the LiDAR at its first scan, stood at `T_world_start` then.
  ContinuedOdometry(std::unique_ptr<Odometry> odometry, const Pose& T_world_start);

  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  std::unique_ptr<Odometry> odometry_;
  Pose T_world_start_;
};

}  // namespace tilth
