#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/core/voxel_table.hpp>
#include <tilth/simulation/map_truth.hpp>
#include <tilth/simulation/mesh_points.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

/// Points by cells as wide as the reach: what is within reach of a place lies in the cells about it.
class ReachGrid {
 public:
  ReachGrid(std::span<const Vector3d> points, double reach) : points_(points), reach_(reach) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t cell = cells_.insert(voxel_key(voxel_of(points[i] / reach), 0));
      if (cell == members_.size()) members_.emplace_back();
      members_[cell].push_back(std::uint32_t(i));
    }
  }

  bool has_near(const Vector3d& p) const {
    const Eigen::Vector3i middle = voxel_of(p / reach_);
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3i offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const std::uint32_t cell = cells_.find(voxel_key(middle + offset, 0));
      if (cell == VoxelTable::kNone) continue;
      const auto is_near = [&](std::uint32_t n) { return (points_[n] - p).squaredNorm() <= reach_ * reach_; };
      if (std::any_of(members_[cell].begin(), members_[cell].end(), is_near)) return true;
    }
    return false;
  }

 private:
  std::span<const Vector3d> points_;
  double reach_;
  VoxelTable cells_;
  std::vector<std::vector<std::uint32_t>> members_;
};

void add_distances(std::vector<double> distances, double reach, MapTruth& truth) {
  std::sort(distances.begin(), distances.end());
  const std::size_t n = distances.size();
  const auto within = std::size_t(std::upper_bound(distances.begin(), distances.end(), reach) - distances.begin());
  double sum = 0, squares = 0, squares_within = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += distances[i], squares += distances[i] * distances[i];
    if (i < within) squares_within += distances[i] * distances[i];
  }
  truth.points = n;
  truth.mean = sum / double(n);
  truth.rmse = std::sqrt(squares / double(n));
  truth.median = distances[n / 2];
  truth.p95 = distances[std::min(n - 1, n * 95 / 100)];
  truth.max = distances.back();
  truth.on_surface = double(within) / double(n);
  truth.rmse_on_surface = within > 0 ? std::sqrt(squares_within / double(within)) : 0.0;
}

/// Takes those out of `hidden` that the sensor sees from a pose, and gives them.
std::vector<Vector3d> take_seen(std::vector<Vector3d>& hidden, const MeshWorld& world, const Pose& T_world_lidar,
                                const MapTruthOptions& options) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<Vector3d> seen, left;
  std::vector<Ray> rays;
  std::vector<Vector3d> aimed_at;
  const Pose T_lidar_world = T_world_lidar.inverse();
  for (const Vector3d& p : hidden) {
    const Vector3d q = T_lidar_world * p;
    const double range = q.norm(), elevation = std::asin(std::clamp(q.z() / std::max(range, 1e-9), -1.0, 1.0));
    const bool in_view = range > 1e-3 && range <= options.max_range && elevation >= options.lowest * kDegree &&
                         elevation <= options.highest * kDegree;
    if (!in_view) {
      left.push_back(p);
      continue;
    }
    rays.push_back({T_world_lidar.translation(), (p - T_world_lidar.translation()) / range});
    aimed_at.push_back(p);
  }
  const std::vector<Hit> hits = world.cast(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double range = (aimed_at[i] - rays[i].origin).norm();
    (std::abs(hits[i].distance - range) < 1e-3 ? seen : left).push_back(aimed_at[i]);
  }
  hidden = std::move(left);
  return seen;
}

}  // namespace

MapTruth judge_map(std::span<const Vector3d> points, const MeshWorld& world, std::span<const Pose> poses,
                   const MapTruthOptions& options) {
  if (points.empty()) throw Error("map", "has no point");
  MapTruth truth;
  add_distances(world.distances(points), options.reach, truth);
  const ReachGrid map(points, options.reach);
  std::vector<Vector3d> hidden = sampled_surface(world.mesh(), options.spacing);
  std::size_t mapped = 0;
  for (const Pose& T_world_lidar : poses) {
    const std::vector<Vector3d> seen = take_seen(hidden, world, T_world_lidar, options);
    truth.seen += seen.size();
    mapped += std::size_t(std::count_if(seen.begin(), seen.end(), [&](const Vector3d& p) { return map.has_near(p); }));
  }
  truth.completeness = truth.seen > 0 ? double(mapped) / double(truth.seen) : 0.0;
  return truth;
}

}  // namespace tilth
