// The world is the LiDAR in its first scan. The map begins with that scan, which hardly anything tells how it was
// taken: some seconds later it is registered to the map that has grown since, and the world laid where it is found.
#pragma once

#include <optional>

#include <tilth/odometry/scan_patches.hpp>
#include <tilth/registration/motion_prior.hpp>

namespace tilth {

class WorldFrame {
 public:
  /// `reanchor_after` [s] the first scan it is registered again; until then the map's frame lies at `T_world_map`.
  explicit WorldFrame(double reanchor_after, const Pose& T_world_map = Pose::Identity())
      : reanchor_after_(reanchor_after), T_world_map_(T_world_map) {}

  /// Until the first scan.
  bool empty() const { return scans_ == 0; }
  /// The second scan is still to tell how the LiDAR moved in the first one.
  bool awaits_second() const { return scans_ == 1; }

  /// The map's frame is the LiDAR in the middle of this scan, and the world's until it is anchored anew.
  void begin(const ScanPatches& first);
  /// The second scan is found; `back` is what it tells about the motion back to the first one.
  void add_second(const MotionPrior& back);

  /// [s] from the middle of the first scan; 0 without one.
  double age(double time) const { return scans_ > 0 ? time - first_time_ : 0.0; }
  double first_time() const { return first_time_; }  ///< [s] of the middle of the first scan

  /// The patches of the first scan at its middle, in which the LiDAR moved like this [rad/s, m/s].
  SurfacePatches first_patches(const Vector6d& velocity) const;

  /// The time to register first_scan() anew by prior_of_first() and to tell anchor(): once, and before that all through
  /// the first second of a start in motion, whose first map is thin.
  bool is_due(double time) const { return first_ && scans_ == 2 && (is_settled(time) || is_thin(time)); }
  const ScanPatches& first_scan() const { return *first_; }
  /// With the size of vibrations as it is known by now.
  MotionPrior prior_of_first(const VibrationSigma& vibration) const;
  /// Lays the world at `T_map_first`, the pose of the first scan, if it was found at `time` [s].
  void anchor(double time, const std::optional<Pose>& T_map_first);

  const Pose& T_world_map() const { return T_world_map_; }

 private:
  bool is_settled(double time) const { return age(time) >= reanchor_after_; }
  bool is_thin(double time) const;

  double reanchor_after_;
  int scans_ = 0;                     // of the first two
  double first_time_ = 0.0;           // [s]
  std::optional<ScanPatches> first_;  // until it is anchored
  MotionPrior back_;                  // from the second scan
  Pose T_world_map_;
};

}  // namespace tilth
