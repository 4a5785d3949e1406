// What a calibration of beams found, in words.
#pragma once

#include <string>
#include <vector>

#include <tilth/calibration/beam_estimator.hpp>

namespace tilth::app {

/// The errors of every beam with their standard deviations, and how well surfaces agree; `metres` were driven.
std::string calibration_table(const BeamCalibration& found, double metres);

/// What the drive says nothing of, beyond `prior`: "elevation of beams 6 to 9, 12", one sentence a kind of error.
std::vector<std::string> not_shown(const BeamEstimate& prior, const BeamEstimate& posterior);

}  // namespace tilth::app
