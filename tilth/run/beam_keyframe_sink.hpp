// Keyframes for the calibration of beams, gathered from a run (docs/beams.md). Memory is bounded.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <tilth/calibration/beam_estimator.hpp>
#include <tilth/core/track_state.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

/// What a run gives a calibration: complete when the sink has finished.
struct GatheredKeyframes {
  KeyframeWindows windows;              ///< evenly chosen of all
  std::size_t rings = 0;                ///< of the sensor: the highest one seen, and one
  std::size_t scans_without_rings = 0;  ///< that have points
  std::size_t left_over = 0;            ///< keyframes of a last window that has too few to be kept
  double bright = BeamModel{}.bright;   ///< intensity from which on a return counts as bright
};

/// A keyframe every `options.step` metres of way, of scans that are tracked and have rings. It is complete one scan
/// later: its motion is the parabola through the poses before, at and after it, since OdometryResult::motion takes the
/// encoder's errors for vibration. A window ends where the track is lost.
class BeamKeyframeSink : public Sink {
 public:
  /// `gathered` must outlive the sink.
  BeamKeyframeSink(const BeamCalibrationOptions& options, GatheredKeyframes& gathered)
      : options_(options), gathered_(gathered) {}

  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;
  void finish(const RunRecord& record) override;

 private:
  void count_rings(const Scan& scan);
  void leave_track(TrackState state);
  void complete_keyframe();
  bool far_enough(const Pose& T_map_sensor) const;
  void begin_keyframe(const Scan& scan, const OdometryResult& result);
  void close_window();
  void keep(std::vector<BeamKeyframe> window);

  BeamCalibrationOptions options_;
  GatheredKeyframes& gathered_;
  std::vector<StampedPose> past_;              // of the sensor, three at most
  std::optional<BeamKeyframe> begun_;          // at the last pose of past_
  std::vector<BeamKeyframe> window_;           // that is being filled
  std::optional<Eigen::Vector3d> last_place_;  // [m] of a keyframe
  std::vector<double> brightness_;             // of each keyframe's scan
  std::size_t windows_ = 0, every_ = 1;        // windows so far, and which of them are kept
};

}  // namespace tilth
