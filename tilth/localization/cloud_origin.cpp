#include <cmath>

#include <tilth/core/median.hpp>
#include <tilth/localization/cloud_origin.hpp>

namespace tilth {

Eigen::Vector3d cloud_origin(std::span<const Eigen::Vector3d> points) {
  constexpr double kFar = 1e4, kRound = 1e3;  // [m]
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : points)
      if (p.allFinite()) values.push_back(p[axis]);
    if (!values.empty()) middle[axis] = median(std::move(values));
  }
  if (middle.cwiseAbs().maxCoeff() < kFar) return Eigen::Vector3d::Zero();
  return {kRound * std::round(middle.x() / kRound), kRound * std::round(middle.y() / kRound), 0};
}

}  // namespace tilth
