#include <cmath>

#include <Eigen/Eigenvalues>

#include <tilth/run/saved_plan.hpp>

namespace tilth {
namespace {

constexpr double kStep = 0.07;       // [m] between points that stand for a patch: each voxel of 10 cm has one
constexpr double kLongest = 0.5;     // [m] from the middle of a patch that it is filled to
constexpr double kLongestLeg = 3.0;  // [m] between places that were driven from one to the other

/// Steps from the middle of a patch to its end along an axis of which it has that variance: that of a uniform spread.
int steps_of(double variance) {
  return int(std::min(std::sqrt(3 * std::max(0.0, variance)), kLongest) / kStep);
}

void add_patch(const SurfacePatch& patch, const Pose& T_map_lidar, std::vector<SeenPoint>& seen) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(patch.covariance);
  const int along = steps_of(axes.eigenvalues()[2]), across = patch.flat ? steps_of(axes.eigenvalues()[1]) : 0;
  for (int i = -along; i <= along; ++i) {
    for (int k = -across; k <= across; ++k) {
      const Eigen::Vector3d p = patch.mean + kStep * (i * axes.eigenvectors().col(2) + k * axes.eigenvectors().col(1));
      seen.push_back({(T_map_lidar * p).cast<float>(), T_map_lidar.translation().cast<float>()});
    }
  }
}

/// The places, and the way between those that follow one another closely.
void go_to(const Eigen::Vector3f& place, std::vector<Eigen::Vector3f>& way) {
  if (!way.empty() && (place - way.back()).norm() < float(kLongestLeg)) {
    const Eigen::Vector3f from = way.back();
    const int steps = int((place - from).norm() / float(kStep));
    for (int i = 1; i <= steps; ++i) way.push_back(from + float(i) / float(steps + 1) * (place - from));
  }
  way.push_back(place);
}

}  // namespace

OccupancyGrid occupancy_of(const PlaceMap& map, const OccupancyOptions& options) {
  std::vector<SeenPoint> seen;
  std::vector<Eigen::Vector3f> way;
  for (std::size_t i = 0; i < map.places().size(); ++i) {
    const Pose& T_map_lidar = map.places()[i].T_map_lidar;
    go_to(T_map_lidar.translation().cast<float>(), way);
    for (const SurfacePatch& patch : map.patches(i)) add_patch(patch, T_map_lidar, seen);
  }
  return occupancy_of(seen, way, options);
}

}  // namespace tilth
