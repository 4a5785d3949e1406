// Any odometry made a SLAM: keyframes, loop closures and a pose graph behind it. What has been passed is corrected by
// what is found later, so trajectory() after the last scan is the answer; register_scan gives odometry's pose.
#pragma once

#include <memory>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/slam/loop_closer.hpp>

namespace tilth {

struct SlamOptions {
  LoopClosingOptions loop;
};

template <class V>
void visit(SlamOptions& o, V&& v) {
  v("loop", o.loop, "[-] loop closure");
}

class Slam : public Odometry {
 public:
  Slam(std::unique_ptr<Odometry> odometry, const SlamOptions& options);
  Slam(const Slam&) = delete;  // the odometry reports its stages to this very object
  Slam& operator=(const Slam&) = delete;

  /// What the odometry makes of the scan; a keyframe closes its loops on the way.
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override { return odometry_->local_map(); }

  /// The last optimisation, with all closures.
  void finish() { closer_.optimize(); }

  /// Every registered scan by odometry alone.
  const Trajectory& odometry_trajectory() const { return trajectory_; }

  /// Every registered scan, moved along with the keyframes before and after it.
  Trajectory trajectory() const;

  const LoopCloser& loops() const { return closer_; }

 private:
  void add_keyframe(const OdometryResult& result, double scan_stamp);

  std::unique_ptr<Odometry> odometry_;
  KeyframeOptions keyframe_options_;
  LoopCloser closer_;
  Trajectory trajectory_;
  double path_ = 0.0;                       // [m]
  Matrix6d covariance_ = Matrix6d::Zero();  // of the registrations since the last keyframe, summed
};

}  // namespace tilth
