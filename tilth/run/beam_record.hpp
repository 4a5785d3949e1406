// What a run shows of its sensor's beams, in words and figures (docs/beams.md).
#pragma once

#include <string>

#include <tilth/run/run_record.hpp>

namespace tilth {

/// "surfaces are 12.9 mm thick, beam 5 reads 17.2 mm short; errors found in 21 of 37 directions (ranges up to 43 mm)".
std::string beams_sentence(const BeamCalibration& found);

/// JSON: windows, keyframes, directions and those in which errors were found, thickness and mean residual of each beam
/// [m], before and after the errors found were taken out; null of a beam that saw no surface.
std::string beams_json(const BeamCalibration& found);

/// Whether errors were found beside those of `known`, the scans' own correction, that move a return at 10 m by more
/// than 3 mm, root mean square: a run without them would be another one.
bool worth_a_second_pass(const BeamCalibration& found, const BeamModel& known);

}  // namespace tilth
