#include <tilth/evaluation/ape.hpp>

namespace tilth {

PoseErrors ape(const MatchedPoses& matches) {
  std::vector<Pose> differences;
  std::vector<double> distances;
  for (std::size_t i = 0; i < matches.truth.size(); ++i) {
    const Pose &truth = matches.truth[i].T_world_lidar, &estimate = matches.estimate[i].T_world_lidar;
    differences.push_back(relative_pose(estimate, truth));
    distances.push_back((estimate.translation() - truth.translation()).norm());
  }
  PoseErrors errors = errors_of(differences);
  errors.translation = metric_of(std::move(distances));
  return errors;
}

}  // namespace tilth
