// Keyframes of a whole run, for the calibration of beams (docs/beams.md). Memory is bounded.
#pragma once

#include <cstddef>

#include <tilth/calibration/beam_estimator.hpp>
#include <tilth/odometry/beam_keyframe_gatherer.hpp>
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

/// Gathers from the scans without their outliers.
class BeamKeyframeSink : public Sink {
 public:
  /// `gathered` must outlive the sink.
  BeamKeyframeSink(const BeamCalibrationOptions& options, GatheredKeyframes& gathered)
      : most_windows_(std::size_t(options.most_windows)), gatherer_(options), gathered_(gathered) {}

  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;
  void finish(const RunRecord& record) override;

 private:
  void keep(BeamKeyframeGatherer::Window window);

  std::size_t most_windows_;
  BeamKeyframeGatherer gatherer_;
  GatheredKeyframes& gathered_;
  std::size_t windows_ = 0, every_ = 1;  // windows so far, and which of them are kept
};

}  // namespace tilth
