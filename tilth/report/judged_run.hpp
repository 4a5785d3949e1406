// A run held against its truth for drawing: aligned over the whole way, as evo does, and the truth where the map is.
#pragma once

#include <string>

#include <tilth/evaluation/evaluate.hpp>

namespace tilth {

struct JudgedRun {
  Evaluation aligned;  ///< moved onto the truth by all positions (SE(3)); by the first pose where these lie on a line
  std::string alignment;      ///< which of the two, in words
  Trajectory truth_in_world;  ///< the truth's matched poses in the frame of the run
};

/// `evaluation`: of the run, aligned by its first pose.
JudgedRun judged(const Evaluation& evaluation);

}  // namespace tilth
