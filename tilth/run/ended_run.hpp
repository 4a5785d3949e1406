// What is asked of a run that came to its end: that it has a pose, and how good its poses are.
#pragma once

#include <string>
#include <vector>

#include <tilth/run/run_record.hpp>
#include <tilth/run/truth_file.hpp>

namespace tilth {

/// Throws Error naming its source, and why, where it has no pose.
void require_scans(const RunRecord& record);

/// Evaluates the run; what prevents that is returned, one sentence each. Whatever the truth's own frame, the run's
/// world is its first pose: so the first poses are made equal. The truth is that of base_link where the run knows it,
/// but of the LiDAR where KITTI's calibration goes with it.
std::vector<std::string> judge_by(const TruthFile& truth, RunRecord& record);

}  // namespace tilth
