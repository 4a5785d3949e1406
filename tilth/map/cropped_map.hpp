// FLOAM's local map (Wang et al. 2021): points in a box around the sensor, one a voxel, and a kd-tree over them. Every
// insertion runs the voxel grid over the whole map again and builds the tree anew: O(map log map).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/search/searchable_cloud.hpp>

namespace tilth {

struct CroppedMapOptions {
  double voxel_size = 0.4;
  double half_width = 100.0;
};

template <class V>
void visit(CroppedMapOptions& o, V&& v) {
  v("voxel_size", o.voxel_size, Bounds{0.01, 100}, "[m] side of a voxel, of the map and of the scan's features");
  v("half_width", o.half_width, Bounds{1, 1e5}, "[m] from the sensor to each side of the box");
}

class CroppedMap {
 public:
  explicit CroppedMap(const CroppedMapOptions& options) : options_(options) {}

  /// The map becomes `points_in_map`, just as they are.
  void reset(std::vector<Eigen::Vector3d> points_in_map) { cloud_ = SearchableCloud(std::move(points_in_map)); }

  /// Adds points, crops to the box around `center` [m] and thins: a voxel's point and the new ones in it become their
  /// mean, all with the same say, so that a voxel forgets half of what it was whenever it gets one point.
  void insert(std::span<const Eigen::Vector3d> points_in_map, const Eigen::Vector3d& center);

  const SearchableCloud& cloud() const { return cloud_; }

 private:
  CroppedMapOptions options_;
  SearchableCloud cloud_{{}};
};

/// The points of both.
PointCloud points_of(const CroppedMap& a, const CroppedMap& b);

}  // namespace tilth
