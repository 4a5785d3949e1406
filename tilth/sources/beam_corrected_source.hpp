// Scans of another source, the constant errors of their beams taken out (docs/beams.md).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <tilth/core/beam_model.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

/// `source` as ideal beams would have measured it, in the sensor's own frame where the cloud's is another one. `file`
/// is where `beams` come from. next() throws Error naming it where a cloud has no rings, or more than `beams`.
std::unique_ptr<ScanSource> beam_corrected_source(std::unique_ptr<ScanSource> source, BeamModel beams,
                                                  std::string file);

/// Throws Error naming `file`, where `beams` come from, if they are fewer than `rings`, and not none.
void require_beams(const BeamModel& beams, std::size_t rings, const std::string& file);

/// "ranges up to 31 mm, elevations up to 0.29 deg, encoder up to 0.05 deg, dim returns up to 12 mm": what is not 0.
std::string largest_errors(const BeamModel& beams);

}  // namespace tilth
