#include <vector>

#include <tilth/evaluation/alignment.hpp>

namespace tilth {
namespace {

std::vector<Eigen::Vector3d> positions_of(const Trajectory& trajectory) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) positions.push_back(pose.T_world_lidar.translation());
  return positions;
}

}  // namespace

Similarity alignment_of(const MatchedPoses& matches, Alignment alignment) {
  if (alignment == Alignment::none) return {};
  if (alignment == Alignment::origin) {
    const Pose T = matches.truth.front().T_world_lidar * matches.estimate.front().T_world_lidar.inverse();
    return {1.0, T.linear(), T.translation()};
  }
  return umeyama(positions_of(matches.estimate), positions_of(matches.truth), alignment == Alignment::sim3);
}

Trajectory transform(Trajectory trajectory, const Similarity& S) {
  for (StampedPose& pose : trajectory) {
    const Pose T = pose.T_world_lidar;
    pose.T_world_lidar.linear() = S.rotation * T.linear();
    pose.T_world_lidar.translation() = S.rotation * (S.scale * T.translation()) + S.translation;
  }
  return trajectory;
}

}  // namespace tilth
