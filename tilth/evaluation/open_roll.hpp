// What an alignment by positions leaves open: where they lie on nearly a straight line, the rotation about it.
// O(poses).
#pragma once

#include <optional>

#include <tilth/evaluation/associate.hpp>

namespace tilth {

struct OpenRoll {
  double off_line = 0.0;  ///< [m] RMS distance of the truth's positions from the line that fits them best
  double angle = 0.0;     ///< [rad] by which errors as large as those left may have turned the estimate about it
};

/// Of matches aligned by their positions. Nothing where these lie off one line by more than a tenth of their spread
/// along it, or where the rotation about it is sure to a degree: the distances of the estimate from the truth, across
/// the line, over the distances of the truth from the line.
std::optional<OpenRoll> open_roll(const MatchedPoses& aligned);

}  // namespace tilth
