#include <cmath>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/consistency.hpp>
#include <tilth/evaluation/pose_error.hpp>

namespace tilth {
namespace {

constexpr double kDof = 6;                                     // of a pose
constexpr double kNormalQuantile = 1.959964;                   // 97.5 % of a normal distribution lie below
constexpr std::array<double, 2> kInside{1.237344, 14.449375};  // 2.5 % and 97.5 % of chi^2 with 6 dof

}  // namespace

Consistency consistency(const MatchedPoses& matches, std::span<const Vector6d> variances) {
  if (variances.size() != matches.estimate.size()) {
    throw Error("consistency", "needs a variance a pose: " + std::to_string(variances.size()) + " for " +
                                   std::to_string(matches.estimate.size()));
  }
  Consistency found;
  double sum = 0, inside = 0;
  for (std::size_t i = 0; i < variances.size(); ++i) {
    if (!(variances[i].array() > 0).all()) continue;
    const Pose moved = relative_pose(matches.estimate.front().T_world_lidar, matches.estimate[i].T_world_lidar);
    const Pose truly_moved = relative_pose(matches.truth.front().T_world_lidar, matches.truth[i].T_world_lidar);
    const Vector6d error = log(normalized(relative_pose(moved, truly_moved)));
    const double nees = (error.array().square() / variances[i].array()).sum();
    sum += nees;
    inside += nees >= kInside[0] && nees <= kInside[1] ? 1 : 0;
    ++found.poses;
  }
  if (found.poses == 0) return found;
  found.mean_nees = sum / double(found.poses);
  found.inside = inside / double(found.poses);
  return found;
}

std::array<double, 2> mean_nees_bounds(std::size_t count) {
  const double dof = kDof * double(count), spread = 2 / (9 * dof);
  const auto bound = [&](double z) { return dof * std::pow(1 - spread + z * std::sqrt(spread), 3) / double(count); };
  return {bound(-kNormalQuantile), bound(kNormalQuantile)};
}

}  // namespace tilth
