// A pipeline that sees each cloud in the frame of the sensor that made it, whose rings lie about its z axis, and tells
// its poses in the frame of the cloud. O(points) more a scan where the two are not the same, else nothing.
#pragma once

#include <memory>

#include <tilth/odometry/odometry.hpp>

namespace tilth {

class MountedOdometry : public Odometry {
 public:
  explicit MountedOdometry(std::unique_ptr<Odometry> odometry);

  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  std::unique_ptr<Odometry> odometry_;
  Pose T_cloud_sensor_ = Pose::Identity();  // of the last scan
};

}  // namespace tilth
