#include <tilth/core/error.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/ended_run.hpp>

namespace tilth {

void require_scans(const RunRecord& record) {
  if (!record.trajectory.empty()) return;
  const std::string reason = record.skipped.empty() ? "it is empty" : record.skipped.front().what;
  throw Error(record.source, "has no scan that can be used; " + reason);
}

std::vector<std::string> judge_by(const TruthFile& truth, RunRecord& record) {
  EvaluationOptions options;
  options.align = Alignment::origin;
  options.association.interpolate = truth.poses.has_stamps;  // truth and poses seldom share their stamps
  try {
    const bool of_lidar = truth.T_camera_lidar.has_value();
    record.evaluation =
        judge(truth, {of_lidar ? record.trajectory : poses_of_base(record.trajectory, record.T_base_lidar), true, {}},
              options);
  } catch (const Error& e) {
    return {e.what()};
  }
  return {};
}

}  // namespace tilth
