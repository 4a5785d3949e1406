#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <tilth/core/flatness.hpp>
#include <tilth/core/symmetric_eigen.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/map/voxel_blocks.hpp>

namespace tilth {
namespace {

// Surfaces are known along their normal only: this variance stands for "anywhere in the voxel" along them [m^2].
constexpr double kAlongSurface = 1.0;

// Shares by which a Gaussian's patches grow before it is made anew.
constexpr double kStale = 1.1;

// The direction that a flat patch faces: -x, +x, -y ... +z; what is not flat has a place of its own.
int facing(const Eigen::Vector3d& normal, bool flat) {
  if (!flat) return 6;
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (normal[axis] > 0);
}

// Has all of `value` fetched from memory.
template <class T>
void prefetch(const T& value) {
  constexpr std::size_t kLine = 64;
  for (std::size_t at = 0; at < sizeof(T); at += kLine) __builtin_prefetch(reinterpret_cast<const char*>(&value) + at);
}

}  // namespace

// In groups, so that what one patch needs of the memory is on its way while others are worked on.
void PatchMap::insert(const SurfacePatches& patches, const Pose& T_map_lidar, double time) {
  constexpr std::size_t kGroup = 16;
  const Eigen::Matrix3d R = T_map_lidar.linear();
  std::array<Placed, kGroup> group;
  for (std::size_t begin = 0; begin < patches.size(); begin += kGroup) {
    const std::size_t count = std::min(kGroup, patches.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const SurfacePatch& patch = patches[begin + i];
      Placed& placed = group[i];
      placed.mean = T_map_lidar * patch.mean;
      placed.normal = R * patch.normal;
      const Eigen::Vector3i voxel = voxel_of(placed.mean / options_.voxel_size);
      placed.cell = cell_of(voxel);
      placed.block_key = voxel_key(block_of(voxel), facing(placed.normal, patch.flat));
      table_.prefetch(placed.block_key);
    }
    for (std::size_t i = 0; i < count; ++i)
      group[i].number = number_of(group[i].block_key, group[i].cell, patches[begin + i].flat);
    for (std::size_t i = 0; i < count; ++i) add(group[i], patches[begin + i], R, time);
  }
}

std::uint32_t PatchMap::number_of(std::int64_t block_key, std::uint32_t cell, bool flat) {
  const std::uint32_t block_number = table_.insert(block_key);
  if (block_number == blocks_.size()) blocks_.push_back({.key = block_key});
  Block& block = blocks_[block_number];
  if ((block.filled >> cell & 1) == 0) {
    block.filled |= std::uint8_t(1 << cell);
    block.surfaces[cell] = std::uint32_t(surfaces_.size());
    surfaces_.push_back({.flat = flat, .planar = flat});
    sums_.push_back({.block = block_number, .cell = cell});
  }
  const std::uint32_t number = block.surfaces[cell];
  prefetch(sums_[number]);
  prefetch(surfaces_[number]);
  return number;
}

void PatchMap::add(const Placed& placed, const SurfacePatch& patch, const Eigen::Matrix3d& R_map_lidar, double time) {
  Sums& sums = sums_[placed.number];
  MapSurface& surface = surfaces_[placed.number];
  if (surface.patches >= std::uint32_t(options_.max_patches)) return;
  ++surface.patches;
  surface.seen_at += (float(time) - surface.seen_at) / float(surface.patches);
  const Eigen::Vector3d before = placed.mean - surface.mean;
  surface.mean += before / double(surface.patches);
  const Eigen::Vector3d after = placed.mean - surface.mean;
  sums.scatter += rotated(R_map_lidar, patch.covariance);
  sums.scatter += Symmetric3d::product(before, after);  // Welford
  sums.normals += placed.normal;
  if (double(surface.patches) < kStale * double(sums.fresh_count)) return;
  refresh(sums, surface);
  sums.fresh_count = surface.patches;
}

// The Gaussian of a surface (docs/method.md, 2).
void PatchMap::refresh(const Sums& sums, MapSurface& surface) const {
  const Symmetric3d covariance = sums.scatter / double(surface.patches);
  const Eigen::Vector3d variances = eigenvalues(covariance);
  const double least = variances[0];
  const Eigen::Vector3d normal = smallest_eigenvector(covariance, least);
  surface.normal = normal.dot(sums.normals) < 0 ? Eigen::Vector3d(-normal) : normal;
  surface.variance = std::max(least, options_.surface_variance);
  surface.planar = surface.flat || (surface.patches >= std::uint32_t(options_.planar_patches) &&
                                    is_flat(variances, kFlatThickness * kFlatThickness));
  surface.covariance = surface.flat
                           ? Eigen::Matrix3d(kAlongSurface * Eigen::Matrix3d::Identity() +
                                             (surface.variance - kAlongSurface) * normal * normal.transpose())
                           : Eigen::Matrix3d(covariance.matrix() + options_.blur * Eigen::Matrix3d::Identity());
}

const MapSurface* PatchMap::find(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, bool flat) const {
  const int kind = facing(normal, flat);
  const Eigen::Vector3i corner = voxel_of(point / options_.voxel_size - Eigen::Vector3d::Constant(0.5));
  const EightVoxels around(corner, kind);
  for (std::size_t i = 0; i < around.blocks; ++i) table_.prefetch(around.block_keys[i]);
  std::array<std::uint32_t, 8> there;
  std::size_t count = 0;
  for (std::size_t i = 0; i < around.blocks; ++i) {
    const std::uint32_t number = table_.find(around.block_keys[i]);
    if (number == VoxelTable::kNone) continue;
    const Block& block = blocks_[number];
    for (unsigned cells = block.filled & around.cells[i]; cells != 0; cells &= cells - 1)
      there[count++] = block.surfaces[std::size_t(std::countr_zero(cells))];
  }
  for (std::size_t i = 0; i < count; ++i) prefetch(surfaces_[there[i]]);
  const MapSurface* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const MapSurface& surface = surfaces_[there[i]];
    const double squared = (surface.mean - point).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = &surface;
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
  const std::vector<Block> blocks = std::exchange(blocks_, {});
  const std::vector<MapSurface> surfaces = std::exchange(surfaces_, {});
  const std::vector<Sums> sums = std::exchange(sums_, {});
  table_.clear();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if ((surfaces[i].mean - center).norm() > options_.max_range) continue;
    const std::uint32_t number = number_of(blocks[sums[i].block].key, sums[i].cell, surfaces[i].flat);
    const std::uint32_t block = sums_[number].block;
    surfaces_[number] = surfaces[i];
    sums_[number] = sums[i];
    sums_[number].block = block;
  }
}

}  // namespace tilth
