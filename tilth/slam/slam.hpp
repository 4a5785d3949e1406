// Any odometry made a SLAM: keyframes, loop closures and a pose graph behind it, on a thread of their own. What has
// been passed is corrected by what is found later, so trajectory() after the last scan is the answer; register_scan
// gives odometry's pose, and T_map_odom() what is known by then of its drift. Where the track was lost and a new map
// begun, localization/join_pieces.hpp finds that in the old one.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/slam/loop_closing_thread.hpp>

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

  /// What the odometry makes of the scan. A keyframe's loops are closed while the next scans come.
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override { return odometry_->local_map(); }

  /// Is called on the thread of the loops after each keyframe. To be set before the first scan.
  void after_keyframe(std::function<void(LoopCloser&)> call) { thread_.after_keyframe(std::move(call)); }

  /// What the loops closed so far make of odometry's newest pose: T_map_lidar = T_map_odom * T_odom_lidar.
  Pose T_map_odom() const { return thread_.T_map_odom(); }

  /// Every registered scan as the loops closed so far have it, moved along with the keyframes before and after it; that
  /// of odometry to the bit until something was optimised. O(scans).
  Trajectory trajectory_so_far() const;
  bool corrected_so_far() const { return thread_.has_corrected(); }

  LoopTimes loop_times() const { return thread_.times(); }

  /// All below wait until the loops of every keyframe so far are closed.
  LoopCloser& loops() { return thread_.closer(); }
  const LoopCloser& loops() const { return thread_.closer(); }

  /// The last optimisation, with all closures.
  void finish() { loops().optimize(); }

  /// Every registered scan, corrected.
  Trajectory trajectory() const;

  /// The scans [first, last) of each map that was begun after a loss and has been joined to the first one.
  std::vector<std::pair<std::size_t, std::size_t>> joined_scans() const;

  /// Every registered scan by odometry alone. Does not wait.
  const Trajectory& odometry_trajectory() const { return trajectory_; }

 private:
  void add_way(const OdometryResult& result);
  bool makes_keyframe(const OdometryResult& result) const;
  void add_keyframe(const OdometryResult& result, double scan_stamp);

  std::unique_ptr<Odometry> odometry_;
  KeyframeOptions keyframe_options_;
  Trajectory moved_along(const std::vector<Pose>& T_map_keyframes) const;

  Trajectory trajectory_;
  std::vector<std::size_t> keyframe_scans_;  // numbers of the registered scans
  double path_ = 0.0;                        // [m]
  double known_until_ = 0.0;                 // [s] stamp of the last pose that is believed
  bool severed_ = false;                     // since the last keyframe
  Matrix6d covariance_ = Matrix6d::Zero();   // of the registrations since the last keyframe, summed
  mutable LoopClosingThread thread_;
};

}  // namespace tilth
