// Relative pose error: how the motion between two poses of the estimate differs from the truth's, as evo defines it.
// O(n).
#pragma once

#include <tilth/evaluation/associate.hpp>
#include <tilth/evaluation/pose_error.hpp>
#include <tilth/evaluation/pose_pairs.hpp>

namespace tilth {

struct RpeOptions {
  PairOptions pairs;
  bool pairs_from_truth = false;  ///< pairs picked on the truth's path and stamps; else on the estimate's
};

/// The errors of (truth_i^-1 truth_j)^-1 (estimate_i^-1 estimate_j) over the pairs (i, j). Throws Error where there are
/// none.
PoseErrors rpe(const MatchedPoses& matches, const RpeOptions& options);

}  // namespace tilth
