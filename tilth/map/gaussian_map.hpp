// A bounded map of Gaussians: each voxel gathers mean and scatter of the points that fell into it, in time proportional
// to the points inserted. What GICP associates with (voxelized GICP, Koide et al. 2021, in the manner of NDT).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>

namespace tilth {

struct GaussianMapOptions {
  double voxel_size = 0.5;
  int min_points = 6;
  int max_points = 200;
  double max_range = 100.0;
};

template <class V>
void visit(GaussianMapOptions& o, V&& v) {
  v("voxel_size", o.voxel_size, Bounds{0.01, 100}, "[m] side of a voxel");
  v("min_points", o.min_points, Bounds{2, 1e6}, "[points] that make a voxel a target");
  v("max_points", o.max_points, Bounds{2, 1e9}, "[points] after which a voxel changes no more");
  v("max_range", o.max_range, Bounds{1, 1e5}, "[m] voxels farther from the sensor are forgotten");
}

struct GaussianVoxel {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< [m] in the map's frame
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();     ///< sum of (p - mean)(p - mean)^T
  std::uint32_t count = 0;

  Eigen::Matrix3d covariance() const { return scatter / double(count - 1); }  ///< [m^2]; count >= 2
};

class GaussianMap {
 public:
  explicit GaussianMap(const GaussianMapOptions& options);

  /// Adds points given in the map's frame. O(points).
  void insert(std::span<const Eigen::Vector3d> points_in_map);

  /// Forgets voxels farther than max_range from `center`. O(voxels), but amortised: it acts once the center has moved far enough.
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
  std::uint32_t& slot_of(std::int64_t key);
  void rebuild(std::size_t slots);

  GaussianMapOptions options_;
  double inverse_size_;
  std::vector<GaussianVoxel> voxels_;
  std::vector<std::int64_t> keys_;  // of voxels_
  std::vector<Slot> slots_;         // open addressing, a power of two, at most half full
  Eigen::Vector3d last_center_ = Eigen::Vector3d::Zero();
};

}  // namespace tilth
