#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Eigenvalues>

#include <tilth/core/error.hpp>
#include <tilth/core/evenly_chosen.hpp>
#include <tilth/core/flatness.hpp>
#include <tilth/core/voxel_table.hpp>
#include <tilth/localization/virtual_places.hpp>

namespace tilth {
namespace {

using Cell2d = std::pair<std::int64_t, std::int64_t>;

constexpr double kGroundCell = 0.5;  // [m]

Cell2d ground_cell_of(const Eigen::Vector3d& p) {
  return {std::int64_t(std::floor(p.x() / kGroundCell)), std::int64_t(std::floor(p.y() / kGroundCell))};
}

struct CellMoments {
  std::uint32_t points = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& p) {
    ++points;
    const Eigen::Vector3d before = p - mean;
    mean += before / double(points);
    scatter += before * (p - mean).transpose();
  }
};

SurfacePatch patch_of(const CellMoments& moments) {
  SurfacePatch patch{.mean = moments.mean};
  patch.covariance = moments.scatter / double(moments.points - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(patch.covariance);
  patch.normal = eigen.eigenvectors().col(0);
  patch.thickness = float(std::max(0.0, eigen.eigenvalues()[0]));
  patch.points = std::uint16_t(std::min<std::uint32_t>(moments.points, 1000));
  patch.flat = is_flat(eigen.eigenvalues(), kFlatThickness * kFlatThickness);
  return patch;
}

SurfacePatches patches_of(std::span<const Eigen::Vector3d> points, const VirtualPlaceOptions& options) {
  VoxelTable table;
  std::vector<CellMoments> cells;
  for (const Eigen::Vector3d& p : points) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e5 * options.cell) continue;
    const std::uint32_t number = table.insert(voxel_key(voxel_of(p / options.cell), 0));
    if (number == cells.size()) cells.emplace_back();
    cells[number].add(p);
  }
  SurfacePatches patches;
  for (const CellMoments& cell : cells)
    if (cell.points >= std::uint32_t(options.min_points)) patches.push_back(patch_of(cell));
  return patches;
}

/// Blocks of the plane, and the patches in each.
class PatchBlocks {
 public:
  PatchBlocks(const SurfacePatches& patches, double side) : patches_(patches), side_(side) {
    for (std::uint32_t i = 0; i < patches.size(); ++i) blocks_[block_of(patches[i].mean)].push_back(i);
  }

  template <class F>
  void for_each_near(const Eigen::Vector3d& place, const F& f) const {
    const auto [bx, by] = block_of(place);
    for (int i = 0; i < 9; ++i) {
      const auto block = blocks_.find({bx + i % 3 - 1, by + i / 3 - 1});
      if (block == blocks_.end()) continue;
      for (const std::uint32_t number : block->second) f(patches_[number]);
    }
  }

 private:
  Cell2d block_of(const Eigen::Vector3d& p) const {
    return {std::int64_t(std::floor(p.x() / side_)), std::int64_t(std::floor(p.y() / side_))};
  }

  const SurfacePatches& patches_;
  double side_;
  std::map<Cell2d, std::vector<std::uint32_t>> blocks_;
};

/// How far one sees in each direction from a place.
class SightLines {
 public:
  void block(const Eigen::Vector3d& seen, double radius) {
    const double range = seen.norm(), angle = std::min(0.5, radius / range);
    const int reach = int(std::ceil(angle / kStep));
    const auto [u, v] = bin_of(seen);
    for (int dv = -reach; dv <= reach; ++dv)
      for (int du = -reach; du <= reach; ++du) nearest(u + du, v + dv) = std::min(nearest(u + du, v + dv), range);
  }

  bool sees(const Eigen::Vector3d& seen) {
    constexpr double kBehind = 0.6;  // [m]
    const auto [u, v] = bin_of(seen);
    return seen.norm() < nearest(u, v) + kBehind;
  }

 private:
  static constexpr int kAround = 240, kUp = 120;
  static constexpr double kStep = 2 * std::numbers::pi / kAround;  // [rad]

  static std::pair<int, int> bin_of(const Eigen::Vector3d& p) {
    return {int(std::floor(std::atan2(p.y(), p.x()) / kStep)),
            int(std::floor(std::atan2(p.z(), p.head<2>().norm()) / kStep)) + kUp / 2};
  }
  double& nearest(int u, int v) {
    const int around = ((u % kAround) + kAround) % kAround, up = std::clamp(v, 0, kUp - 1);
    return ranges_[std::size_t(up * kAround + around)];
  }

  std::vector<double> ranges_ = std::vector<double>(kAround * kUp, std::numeric_limits<double>::infinity());
};

/// What a place sees, in its frame; surfaces face it.
SurfacePatches seen_from(const Eigen::Vector3d& place, const PatchBlocks& blocks, const VirtualPlaceOptions& options) {
  SurfacePatches near;
  SightLines lines;
  blocks.for_each_near(place, [&](const SurfacePatch& patch) {
    const Eigen::Vector3d seen = patch.mean - place;
    if (seen.norm() > options.range || seen.norm() < options.cell) return;
    near.push_back(patch);
    near.back().mean = seen;
    if (patch.normal.dot(seen) > 0) near.back().normal = -patch.normal;
    lines.block(seen, 0.5 * options.cell);
  });
  std::erase_if(near, [&](const SurfacePatch& patch) { return !lines.sees(patch.mean); });
  return evenly_chosen<SurfacePatch>(near, std::size_t(options.max_patches));
}

/// Cells of the plane with the height of their lowest level surface, less those where something stands in the way of a
/// LiDAR, and those with something beneath: a ceiling is no ground.
std::map<Cell2d, double> free_ground(const SurfacePatches& patches, double height) {
  constexpr double kLevel = 0.9, kStep = 0.3, kBeneath = 0.6;  // cosine, [m] that one drives over, [m]
  constexpr std::int64_t kAside = 1, kAbout = 3;               // [cells] that stay free, that have nothing beneath
  std::map<Cell2d, double> ground;
  for (const SurfacePatch& patch : patches) {
    if (!patch.flat || std::abs(patch.normal.z()) < kLevel) continue;
    double& z = ground.try_emplace(ground_cell_of(patch.mean), patch.mean.z()).first->second;
    z = std::min(z, patch.mean.z());
  }
  std::set<Cell2d> taken;
  for (const SurfacePatch& patch : patches) {
    const auto [x, y] = ground_cell_of(patch.mean);
    for (std::int64_t i = 0; i < (2 * kAbout + 1) * (2 * kAbout + 1); ++i) {
      const std::int64_t dx = i % (2 * kAbout + 1) - kAbout, dy = i / (2 * kAbout + 1) - kAbout;
      const auto floor = ground.find({x + dx, y + dy});
      if (floor == ground.end()) continue;
      const double above = patch.mean.z() - floor->second;
      const bool near = std::max(std::abs(dx), std::abs(dy)) <= kAside;
      if (above < -kBeneath || (near && above > kStep && above < height + kStep)) taken.insert(floor->first);
    }
  }
  for (const Cell2d& cell : taken) ground.erase(cell);
  return ground;
}

/// Places of a LiDAR above free ground.
std::vector<Eigen::Vector3d> free_places(const SurfacePatches& patches, const VirtualPlaceOptions& options) {
  std::vector<Eigen::Vector3d> places;
  std::set<Cell2d> near;  // places, by cells of the step
  for (const auto& [cell, z] : free_ground(patches, options.height)) {
    const Eigen::Vector3d place((double(cell.first) + 0.5) * kGroundCell, (double(cell.second) + 0.5) * kGroundCell,
                                z + options.height);
    const Cell2d coarse{std::int64_t(std::floor(place.x() / options.step)),
                        std::int64_t(std::floor(place.y() / options.step))};
    if (near.insert(coarse).second) places.push_back(place);
  }
  return places;
}

}  // namespace

void make_virtual_places(std::span<const Eigen::Vector3d> points, const VirtualPlaceOptions& options,
                         const std::function<void(const VirtualPlace&)>& take) {
  const SurfacePatches patches = patches_of(points, options);
  const std::vector<Eigen::Vector3d> places = free_places(patches, options);
  if (places.empty()) {
    throw Error("cloud", "has no free ground: no level surface of " + std::to_string(options.cell) +
                             " m with nothing above it; z must point up, lengths be in metres");
  }
  const PatchBlocks blocks(patches, options.range);
  for (const Eigen::Vector3d& place : places)
    take({Pose(Eigen::Translation3d(place)), seen_from(place, blocks, options)});
}

}  // namespace tilth
