// A bounded map of Gaussians: each voxel gathers mean and scatter of the points that fell into it, in time proportional
// to the points inserted. What GICP associates with (voxelized GICP, Koide et al. 2021, in the manner of NDT).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>

namespace tilth {

/// What becomes of a voxel's covariance before it is a target: `none`, the sample covariance as it is; `surface`, a
/// surface constrains along its normal only, a flat single line (what one beam draws, which travels with the sensor)
/// not at all, and any other shape is blurred.
enum class Regularization { none, surface };
inline std::span<const std::string_view> names_of(Regularization) {
  static constexpr std::array<std::string_view, 2> names{"none", "surface"};
  return names;
}

struct GaussianMapOptions {
  double voxel_size = 0.6;
  int min_points = 6;
  int max_points = 200;
  double max_range = 100.0;
  Regularization regularization = Regularization::surface;
  double surface_thickness = 0.1;
  double surface_width = 0.05;
  double surface_variance = 1e-4;
  double blur = 0.01;
};

template <class V>
void visit(GaussianMapOptions& o, V&& v) {
  v("voxel_size", o.voxel_size, Bounds{0.01, 100}, "[m] side of a voxel");
  v("min_points", o.min_points, Bounds{2, 1e6}, "[points] that make a voxel a target");
  v("max_points", o.max_points, Bounds{2, 1e9}, "[points] after which a voxel changes no more");
  v("max_range", o.max_range, Bounds{1, 1e5}, "[m] voxels farther from the sensor are forgotten");
  v("regularization", o.regularization,
    "[-] none: sample covariances; surface: surfaces constrain along their normal, the rest is blurred");
  v("surface_thickness", o.surface_thickness, Bounds{0, 1},
    "[-] a surface's smallest variance, as a share of its middle one, at most");
  v("surface_width", o.surface_width, Bounds{0, 1},
    "[-] a surface's middle variance, as a share of its largest one, at least");
  v("surface_variance", o.surface_variance, Bounds{0, 1}, "[m^2] variance along a surface's normal, at least");
  v("blur", o.blur, Bounds{0, 100}, "[m^2] variance added to what is no surface");
}

struct GaussianVoxel {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< [m] in the map's frame
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();                        ///< [m^2] regularised; at most a tenth of its points out of date
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  ///< sum of (p - mean)(p - mean)^T
  std::uint32_t count = 0;
  std::uint32_t covariance_count = 0;  ///< points when `covariance` was made
};

class GaussianMap {
 public:
  explicit GaussianMap(const GaussianMapOptions& options);

  /// Adds points given in the map's frame. O(points).
  void insert(std::span<const Eigen::Vector3d> points_in_map);

  /// Forgets voxels farther than max_range from `center`. O(voxels), but amortised: it acts once the center has moved
  /// far enough.
  void crop(const Eigen::Vector3d& center);

  /// The Gaussian of the voxel around `point`, or nullptr where there is none with at least min_points.
  const GaussianVoxel* find(const Eigen::Vector3d& point) const;

  /// Of the eight voxels around `point`, the Gaussian whose mean is nearest to it, or nullptr.
  const GaussianVoxel* find_nearest(const Eigen::Vector3d& point) const;

  const std::vector<GaussianVoxel>& voxels() const { return voxels_; }
  const GaussianMapOptions& options() const { return options_; }

 private:
  struct Slot {
    std::int64_t key;
    std::uint32_t voxel;
  };

  const GaussianVoxel* at(std::int64_t x, std::int64_t y, std::int64_t z) const;
  std::size_t slot_of(std::int64_t key) const;
  void rebuild(std::size_t slots);
  void refresh(GaussianVoxel& voxel) const;

  GaussianMapOptions options_;
  double inverse_size_;
  std::vector<GaussianVoxel> voxels_;
  std::vector<std::int64_t> keys_;  // of voxels_
  std::vector<Slot> slots_;         // open addressing, a power of two, at most half full
  Eigen::Vector3d last_center_ = Eigen::Vector3d::Zero();
};

}  // namespace tilth
