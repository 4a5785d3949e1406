// Any odometry made a SLAM: keyframes, loop closures and a pose graph behind it. What has been passed is corrected by
// what is found later, so trajectory() after the last scan is the answer; register_scan gives odometry's pose. Where
// the track was lost and a new map begun, localization/join_pieces.hpp finds that in the old one.
#pragma once

#include <memory>
#include <utility>
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

  /// See LoopCloser::join_pieces.
  void join_pieces(const std::vector<Constraint>& ties) { closer_.join_pieces(ties); }

  /// The last optimisation, with all closures.
  void finish() { closer_.optimize(); }

  /// Every registered scan by odometry alone.
  const Trajectory& odometry_trajectory() const { return trajectory_; }

  /// Every registered scan, moved along with the keyframes before and after it.
  Trajectory trajectory() const;

  /// The scans [first, last) of each map that was begun after a loss and has been joined to the first one.
  std::vector<std::pair<std::size_t, std::size_t>> joined_scans() const;

  const LoopCloser& loops() const { return closer_; }

 private:
  void add_way(const OdometryResult& result);
  bool makes_keyframe(const OdometryResult& result) const;
  void add_keyframe(const OdometryResult& result, double scan_stamp);

  std::unique_ptr<Odometry> odometry_;
  KeyframeOptions keyframe_options_;
  LoopCloser closer_;
  Trajectory trajectory_;
  double path_ = 0.0;                       // [m]
  double known_until_ = 0.0;                // [s] stamp of the last pose that is believed
  bool severed_ = false;                    // since the last keyframe
  Matrix6d covariance_ = Matrix6d::Zero();  // of the registrations since the last keyframe, summed
};

}  // namespace tilth
