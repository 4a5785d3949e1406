#include <algorithm>

#include <tilth/features/plane_misfit.hpp>

namespace tilth {

PlaneMisfit plane_misfit(const RunSet& three, const Eigen::Vector3d& normal) {
  PlaneMisfit misfit;
  double heights = 0, squares = 0;  // of the means over the first one
  for (const Moments* run : three) {
    const double height = normal.dot(run->mean - three[0]->mean);
    misfit.within += run->scatter.along(normal);
    misfit.points += run->count;
    heights += run->count * height;
    squares += run->count * height * height;
  }
  misfit.between = std::max(0.0, squares - heights * heights / misfit.points);
  return misfit;
}

bool is_one_plane(const PlaneMisfit& misfit, double max_sigma, double roughness) {
  constexpr double kFitted = 6;  // of the freedom of the points: three means, and the plane
  const double variance = misfit.within / std::max(1.0, misfit.points - kFitted);
  return misfit.between <= max_sigma * max_sigma * variance + misfit.points * roughness * roughness;
}

}  // namespace tilth
