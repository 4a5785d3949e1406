#include <array>
#include <cmath>
#include <limits>

#include <tilth/core/least_spread.hpp>
#include <tilth/map/patch_map.hpp>

namespace tilth {
namespace {

// Surfaces are known along their normal only: this variance stands for "anywhere in the voxel" along them [m^2].
constexpr double kAlongSurface = 1.0;

// The steps in a key from a voxel to itself and its seven neighbours upwards.
constexpr std::array<std::int64_t, 8> kEightVoxels = [] {
  constexpr std::int64_t x = voxel_key_step(0), y = voxel_key_step(1), z = voxel_key_step(2);
  return std::array<std::int64_t, 8>{0, x, y, x + y, z, x + z, y + z, x + y + z};
}();

// Shares by which a Gaussian's patches grow before it is made anew.
constexpr double kStale = 1.1;

// The direction that a flat patch faces: -x, +x, -y ... +z; what is not flat has a place of its own.
int facing(const Eigen::Vector3d& normal, bool flat) {
  if (!flat) return 6;
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (normal[axis] > 0);
}

}  // namespace

void PatchMap::insert(const SurfacePatches& patches, const Pose& T_map_lidar, double time) {
  const Eigen::Matrix3d R = T_map_lidar.linear();
  for (const SurfacePatch& patch : patches) {
    const Eigen::Vector3d mean = T_map_lidar * patch.mean, normal = R * patch.normal;
    const std::int64_t key = voxel_key(voxel_of(mean / options_.voxel_size), facing(normal, patch.flat));
    const std::uint32_t number = table_.insert(key);
    if (number == surfaces_.size()) {
      surfaces_.push_back({.flat = patch.flat});
      sums_.push_back({.key = key});
    }
    Sums& sums = sums_[number];
    if (sums.count >= std::uint32_t(options_.max_patches)) continue;
    MapSurface& surface = surfaces_[number];
    ++sums.count;
    surface.seen_at += (float(time) - surface.seen_at) / float(sums.count);
    const Eigen::Vector3d before = mean - surface.mean;
    surface.mean += before / double(sums.count);
    sums.scatter.noalias() += before * (mean - surface.mean).transpose();  // Welford
    sums.covariances.noalias() += R * patch.covariance * R.transpose();
    sums.normals += normal;
    if (double(sums.count) < kStale * double(sums.fresh_count)) continue;
    refresh(sums, surface);
    sums.fresh_count = sums.count;
  }
}

void PatchMap::refresh(const Sums& sums, MapSurface& surface) const {
  const Eigen::Matrix3d covariance = (sums.scatter + sums.covariances) / double(sums.count);
  const double least = spreads(covariance)[0];
  const Eigen::Vector3d normal = direction_of_least(covariance, least);
  surface.normal = normal.dot(sums.normals) < 0 ? Eigen::Vector3d(-normal) : normal;
  surface.variance = std::max(least, options_.surface_variance);
  surface.covariance = surface.flat ? Eigen::Matrix3d(kAlongSurface * Eigen::Matrix3d::Identity() +
                                                      (surface.variance - kAlongSurface) * normal * normal.transpose())
                                    : Eigen::Matrix3d(covariance + options_.blur * Eigen::Matrix3d::Identity());
}

const MapSurface* PatchMap::find(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, bool flat) const {
  const int kind = facing(normal, flat);
  const Eigen::Vector3i corner = voxel_of(point / options_.voxel_size - Eigen::Vector3d::Constant(0.5));
  const MapSurface* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const std::int64_t first_key = voxel_key(corner, kind);
  for (const std::int64_t step : kEightVoxels) {
    const std::uint32_t number = table_.find(first_key + step);
    if (number == VoxelTable::kNone) continue;
    const double squared = (surfaces_[number].mean - point).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = &surfaces_[number];
  }
  return nearest;
}

std::vector<Eigen::Vector3d> PatchMap::means() const {
  std::vector<Eigen::Vector3d> means;
  means.reserve(surfaces_.size());
  for (const MapSurface& surface : surfaces_) means.push_back(surface.mean);
  return means;
}

void PatchMap::crop(const Eigen::Vector3d& center) {
  constexpr double kMoved = 0.1;  // of the range: how far the center moves before voxels are looked through
  if ((center - last_center_).norm() < kMoved * options_.max_range) return;
  last_center_ = center;
  std::vector<MapSurface> near_surfaces;
  std::vector<Sums> near_sums;
  table_.clear();
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if ((surfaces_[i].mean - center).norm() > options_.max_range) continue;
    table_.insert(sums_[i].key);
    near_surfaces.push_back(surfaces_[i]);
    near_sums.push_back(sums_[i]);
  }
  surfaces_.swap(near_surfaces);
  sums_.swap(near_sums);
}

}  // namespace tilth
