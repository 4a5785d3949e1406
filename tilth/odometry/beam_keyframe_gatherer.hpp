// Keyframes for the calibration of beams, gathered scan by scan from what an odometry makes of them (docs/beams.md).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <tilth/calibration/beam_keyframe.hpp>
#include <tilth/calibration/beam_options.hpp>
#include <tilth/core/track_state.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/odometry/odometry.hpp>

namespace tilth {

/// A keyframe every `options.step` metres of way, of scans that are tracked and have rings. It is complete one scan
/// later: its motion is the parabola through the poses before, at and after it, since OdometryResult::motion takes the
/// encoder's errors for vibration. A window of `options.window` keyframes ends where the track is lost.
class BeamKeyframeGatherer {
 public:
  using Window = std::vector<BeamKeyframe>;

  explicit BeamKeyframeGatherer(const BeamCalibrationOptions& options) : options_(options) {}

  /// `cloud` has the returns of `scan` as they are to be calibrated, in the same frame. The window, where that
  /// completed one.
  std::optional<Window> take(const Scan& scan, const PointCloud& cloud, const OdometryResult& result);

  /// No scan comes any more: what is left, if it is more than half a window.
  std::optional<Window> finish();

  std::size_t rings() const { return rings_; }  ///< of the sensor: the highest one seen, and one
  std::size_t scans_without_rings() const { return scans_without_rings_; }  ///< that have points
  std::size_t left_over() const { return window_.size(); }  ///< keyframes of a window that is not complete

  /// Intensity from which on a return counts as bright: the median of the keyframes.
  double bright() const;

 private:
  void count_rings(const PointCloud& cloud);
  std::optional<Window> leave_track(TrackState state);
  std::optional<Window> complete_keyframe();
  bool far_enough(const Pose& T_map_sensor) const;
  void begin_keyframe(const Scan& scan, const PointCloud& cloud, const OdometryResult& result);
  std::optional<Window> close_window();

  BeamCalibrationOptions options_;
  std::size_t rings_ = 0, scans_without_rings_ = 0;
  std::vector<StampedPose> past_;              // of the sensor, three at most
  std::optional<BeamKeyframe> begun_;          // at the last pose of past_
  Window window_;                              // that is being filled
  std::optional<Eigen::Vector3d> last_place_;  // [m] of a keyframe
  std::vector<double> brightness_;             // of each keyframe's scan
};

}  // namespace tilth
