#include <tilth/evaluation/rpe.hpp>

namespace tilth {

PoseErrors rpe(const MatchedPoses& matches, const RpeOptions& options) {
  const Trajectory& chosen = options.pairs_from_truth ? matches.truth : matches.estimate;
  std::vector<Pose> differences;
  for (const auto& [i, j] : pose_pairs(chosen, options.pairs)) {
    const Pose truth = relative_pose(matches.truth[i].T_world_lidar, matches.truth[j].T_world_lidar);
    const Pose estimate = relative_pose(matches.estimate[i].T_world_lidar, matches.estimate[j].T_world_lidar);
    differences.push_back(relative_pose(truth, estimate));
  }
  return errors_of(differences);
}

}  // namespace tilth
