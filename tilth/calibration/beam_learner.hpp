// The errors of a sensor's beams while it drives: window after window, a little work a scan, memory bounded
// (docs/beams.md). The same windows in the same order give the same errors.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include <tilth/calibration/beam_estimator.hpp>
#include <tilth/calibration/beam_evidence.hpp>

namespace tilth {

class BeamLearner {
 public:
  /// `known` are errors that the scans are corrected by already, before they come here, and how well they are known.
  explicit BeamLearner(const BeamCalibrationOptions& options, std::optional<BeamEstimate> known = {});

  /// Takes in what a sensor of `rings` beams saw, whose returns count as bright from `bright` on.
  void add(std::vector<BeamKeyframe> window, std::size_t rings, double bright);

  /// Linearizes one window, where there is one to do; true where that made beams() other ones. O(returns of a window).
  bool work();

  /// By which scans as they come are to be corrected from now on: by nothing, until enough windows agree on errors.
  const BeamModel& beams() const { return model_; }

  const BeamCalibrationOptions& options() const { return options_; }

  /// What the windows say so far, together with what was known; nothing where they are too few to disagree.
  const std::optional<BeamCalibration>& found() const { return found_; }

 private:
  struct Kept {
    std::vector<BeamKeyframe> keyframes;
    BeamWindow linear;
    WindowEvidence evidence;
  };

  void begin(std::size_t rings, double bright);
  bool end_of_round();
  std::vector<WindowEvidence> evidence() const;
  BeamFit fit_of_kept() const;
  void move_to(const Eigen::VectorXd& theta);
  void tell(const BeamBelief& belief);
  void freeze();

  BeamCalibrationOptions options_;
  std::optional<BeamEstimate> known_;
  BeamEstimate prior_;  // of errors beside the known ones
  std::optional<PriorUnits> units_;
  BeamModel known_model_;
  BeamModel model_;                              // errors beside the known ones
  Eigen::VectorXd theta_;                        // at which windows are linearized
  std::deque<Kept> kept_;                        // whose returns are at hand still
  std::vector<WindowEvidence> frozen_;           // of windows whose returns are not
  std::size_t next_ = 0;                         // of kept_, to be linearized
  std::size_t added_ = 0, keyframes_ = 0, due_;  // windows so far, their keyframes; windows the next solution waits for
  int round_ = 0;                                // of Gauss-Newton over the windows kept
  BeamFit before_;
  std::optional<BeamCalibration> found_;
};

}  // namespace tilth
