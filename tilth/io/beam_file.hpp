// The errors of a sensor's beams as YAML that people can read and write: beams.yaml. Angles are in degrees; numbers
// come back to the last bit. A key that is left out is 0; the covariance, where there is one, is in [m] and [rad].
// O(bytes), O(n^3) of n parameters where there is a covariance.
#pragma once

#include <filesystem>
#include <string>

#include <tilth/core/beam_estimate.hpp>

namespace tilth {

/// Throws Error where the file cannot be written.
void write_beams(const std::filesystem::path& path, const BeamEstimate& estimate);

/// Throws Error naming file, line, key and bound: broken YAML, an unknown version or key, lists of different length or
/// of more than 256 beams, a number that is not finite, errors beyond 1 m or 5 degrees, a covariance of another size
/// than 2 n + 5 or one that is not positive semidefinite.
BeamEstimate read_beams(const std::filesystem::path& path);
BeamEstimate parse_beams(const std::string& text, const std::string& name);

}  // namespace tilth
