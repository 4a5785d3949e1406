#include <algorithm>

#include <tilth/core/error.hpp>
#include <tilth/core/trajectory.hpp>

namespace tilth {

Pose interpolate(const Trajectory& trajectory, double stamp) {
  if (trajectory.empty()) throw Error("trajectory", "has no pose to interpolate");
  if (trajectory.size() == 1) return trajectory.front().T_world_lidar;
  const auto after = std::upper_bound(trajectory.begin() + 1, trajectory.end() - 1, stamp,
                                      [](double t, const StampedPose& pose) { return t < pose.stamp; });
  const StampedPose &a = *(after - 1), &b = *after;
  if (b.stamp <= a.stamp) return a.T_world_lidar;
  return interpolate(a.T_world_lidar, b.T_world_lidar, (stamp - a.stamp) / (b.stamp - a.stamp));
}

double path_length(const Trajectory& trajectory) {
  double length = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].T_world_lidar.translation() - trajectory[i - 1].T_world_lidar.translation()).norm();
  }
  return length;
}

}  // namespace tilth
