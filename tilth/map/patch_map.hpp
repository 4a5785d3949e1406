// A bounded map of Gaussians that gather patches of surface. Each voxel keeps one Gaussian for each of the six
// directions that a flat patch can face, and one for everything that is not flat: floor and wall that meet in a voxel,
// or the two sides of a door, do not mix. The target of GICP (voxelized as in Koide et al. 2021). Time grows with the
// patches.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/options.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/core/symmetric3.hpp>
#include <tilth/core/voxel_table.hpp>

namespace tilth {

struct PatchMapOptions {
  double voxel_size = 0.5;
  int max_patches = 60;
  double max_range = 100.0;
  double surface_variance = 1e-4;
  double blur = 0.01;
  int planar_patches = 10;
};

template <class V>
void visit(PatchMapOptions& o, V&& v) {
  v("voxel_size", o.voxel_size, Bounds{0.01, 100}, "[m] side of a voxel");
  v("max_patches", o.max_patches, Bounds{1, 1e9}, "[patches] after which a Gaussian changes no more", kAdvanced);
  v("max_range", o.max_range, Bounds{1, 1e5}, "[m] voxels farther from the sensor are forgotten");
  v("surface_variance", o.surface_variance, Bounds{1e-12, 1}, "[m^2] variance along a surface's normal, at least",
    kAdvanced);
  v("blur", o.blur, Bounds{0, 100}, "[m^2] variance added to what is no surface", kAdvanced);
  v("planar_patches", o.planar_patches, Bounds{2, 1e9},
    "[patches] none of them flat, that make a plane together if they lie in one", kAdvanced);
}

/// The surface of one voxel that faces one way, or what there is in it that is not flat.
struct MapSurface {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< [m] in the map's frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();      ///< unit, towards where it was seen from
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2] wide along a flat surface
  double variance = 0.0;                                 ///< [m^2] along the normal
  float seen_at = 0.0F;                                  ///< [s] mean time of its patches
  std::uint32_t patches = 0;                             ///< of which `mean` is the mean
  bool flat = false;                                     ///< its patches are flat
  bool planar = false;                                   ///< it lies in one plane, whether or not each patch shows it
};

class PatchMap {
 public:
  explicit PatchMap(const PatchMapOptions& options) : options_(options) {}

  /// Adds patches of a scan, given in the sensor's frame; `time` [s] of the scan is since the first one. O(patches).
  void insert(const SurfacePatches& patches, const Pose& T_map_lidar, double time = 0.0);

  /// Forgets voxels farther than max_range from `center`. O(voxels), but amortised: it acts once the center has moved
  /// far enough.
  void crop(const Eigen::Vector3d& center);

  /// Of the eight voxels around `point`, the nearest surface that faces as a patch with `normal` does (any direction
  /// where the patch is not `flat`), or nullptr.
  const MapSurface* find(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, bool flat) const;

  /// Where the surfaces are. O(surfaces).
  std::vector<Eigen::Vector3d> means() const;

  const std::vector<MapSurface>& surfaces() const { return surfaces_; }

 private:
  /// Two voxels an edge, of what faces one way: neighbours are found together.
  struct Block {
    std::int64_t key;
    std::array<std::uint32_t, 8> surfaces = {};  ///< numbers; by the voxel's x + 2 y + 4 z in the block
    std::uint8_t filled = 0;                     ///< a bit for each voxel that has one
  };

  struct Sums {
    std::uint32_t block, cell;                          ///< where its number stands
    std::uint32_t fresh_count = 0;                      ///< patches when the surface was last made
    Symmetric3d scatter = {};                           ///< of the patches' means, and sum of their covariances
    Eigen::Vector3d normals = Eigen::Vector3d::Zero();  ///< sum over the patches
  };

  /// A patch of a scan, in the map's frame.
  struct Placed {
    std::int64_t block_key;
    std::uint32_t cell;
    Eigen::Vector3d mean, normal;
    std::uint32_t number;  ///< of its surface
  };

  /// Of the surface in a cell of a block; a new one where there is none.
  std::uint32_t number_of(std::int64_t block_key, std::uint32_t cell, bool flat);
  void add(const Placed& placed, const SurfacePatch& patch, const Eigen::Matrix3d& R_map_lidar, double time);
  void refresh(const Sums& sums, MapSurface& surface) const;

  PatchMapOptions options_;
  VoxelTable table_;  // of blocks_
  std::vector<Block> blocks_;
  std::vector<MapSurface> surfaces_;
  std::vector<Sums> sums_;  // of surfaces_
  Eigen::Vector3d last_center_ = Eigen::Vector3d::Zero();
};

}  // namespace tilth
