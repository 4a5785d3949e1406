// The errors of a sensor's beams from windows of keyframes: Gauss-Newton with a prior, and what the windows agree on
// (docs/beams.md).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <tilth/calibration/beam_calibration.hpp>
#include <tilth/calibration/beam_keyframe.hpp>
#include <tilth/calibration/beam_options.hpp>
#include <tilth/calibration/beam_window.hpp>

namespace tilth {

using KeyframeWindows = std::vector<std::vector<BeamKeyframe>>;

/// What is known of a sensor that nobody has calibrated.
BeamEstimate prior_beams(std::size_t rings, double bright, const BeamCalibrationOptions& options);

/// `known`, whose lists or covariance may be missing, with those of a sensor that nobody has calibrated in their place;
/// of `rings` beams where it has no list. It must not have fewer beams than that.
BeamEstimate completed(const BeamEstimate& known, std::size_t rings, const BeamCalibrationOptions& options);

/// Called after each iteration of `iterations`.
using CalibrationProgress = std::function<void(int iteration, int iterations)>;

/// The posterior of `prior`, given the windows. Of directions that the windows do not agree on beyond
/// `options.significance` deviations the prior's mean stays, with a covariance that says what is not known.
BeamCalibration estimate_beams(KeyframeWindows windows, const BeamEstimate& prior,
                               const BeamCalibrationOptions& options, const CalibrationProgress& progress = {});

}  // namespace tilth
