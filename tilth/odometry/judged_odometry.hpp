// Any pipeline with a judge beside it, who says of every pose whether it is to be believed.
#pragma once

#include <memory>

#include <tilth/odometry/odometry.hpp>
#include <tilth/odometry/track_judge.hpp>

namespace tilth {

/// [rad^2, m^2] of a pose after `time` [s] of which nothing is known: by the accelerations that a robot has at times,
/// later by its speed.
Matrix6d drift_after(double time);

class JudgedOdometry : public Odometry {
 public:
  explicit JudgedOdometry(std::unique_ptr<Odometry> odometry);
  JudgedOdometry(const JudgedOdometry&) = delete;  // the odometry reports its stages to this very object
  JudgedOdometry& operator=(const JudgedOdometry&) = delete;

  /// What the pipeline makes of the scan, with its track; the covariance of a pose that is not believed grows with the
  /// time since the last one that was.
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override { return odometry_->local_map(); }

 private:
  std::unique_ptr<Odometry> odometry_;
  TrackJudge judge_;
};

}  // namespace tilth
