// Absolute pose error: how far each pose of the estimate lies from its pose of the truth, as evo defines it. O(n).
#pragma once

#include <tilth/evaluation/associate.hpp>
#include <tilth/evaluation/pose_error.hpp>

namespace tilth {

/// The errors of the matches as they lie (align the estimate before). Translation: distance of the two positions;
/// rotation and full: of T_estimate^-1 T_truth. Throws Error where there are no matches.
PoseErrors ape(const MatchedPoses& matches);

}  // namespace tilth
