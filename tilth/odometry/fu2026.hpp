// The method of Fu et al., Appl. Sci. 2026, 16, 3141, as it is printed. What that text leaves open is FLOAM's or an
// option; docs/paper.md says which. `improved_floam` is the method as we read it.
#pragma once

#include <tilth/features/floam_features.hpp>
#include <tilth/map/cropped_map.hpp>
#include <tilth/odometry/motion_model.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/preprocess/outlier_removal.hpp>
#include <tilth/registration/align.hpp>
#include <tilth/registration/neighborhood_gaussians.hpp>

namespace tilth {

/// Whose neighbours make a feature's covariance.
enum class Neighborhood { scan, features };
inline std::span<const std::string_view> names_of(Neighborhood) {
  static constexpr std::array<std::string_view, 2> names{"scan", "features"};
  return names;
}

/// The filter of section 2.3 in metres, its threshold without bounds.
constexpr OutlierOptions printed_filter() {
  OutlierOptions filter;
  filter.method = OutlierMethod::weighted;
  filter.density_min = -1e9;
  filter.density_max = 1e9;
  filter.per_range = false;
  filter.ball = DensityBall::smallest;
  return filter;
}

struct Fu2026Options {
  double min_range = 0.5;
  double max_range = 90.0;
  double pose_at = 0.5;
  OutlierOptions outliers = printed_filter();
  int min_ring_points = 131;
  int edges = 3;
  int planes = 9;
  int neighbors = 10;
  double lambda = 1e-6;
  Neighborhood neighborhood = Neighborhood::scan;
  double max_distance = 1.0;
  bool predict = false;
  AlignOptions align;
  CroppedMapOptions edge_map{.voxel_size = 0.2};
  CroppedMapOptions plane_map{.voxel_size = 0.4};
};

template <class V>
void visit(Fu2026Options& o, V&& v) {
  v("min_range", o.min_range, Bounds{0, 1e4}, "[m] nearer points are dropped");
  v("max_range", o.max_range, Bounds{0.1, 1e4}, "[m] farther points are dropped");
  v("pose_at", o.pose_at, Bounds{0, 1},
    "[-] instant that a pose is stamped with: 0 the scan's first point, 1 its last one; the scan is not deskewed, so "
    "its "
    "middle fits best");
  v("outliers", o.outliers, "[-] statistical outlier removal");
  v("min_ring_points", o.min_ring_points, Bounds{11, 1e6}, "[points] a ring of fewer gives no features", kAdvanced);
  v("edges", o.edges, Bounds{0, 1e6}, "[points] of a sector, six a ring: the most curved, at most");
  v("planes", o.planes, Bounds{1, 1e6}, "[points] of a sector: the least curved of the others, at most");
  v("neighbors", o.neighbors, Bounds{2, 64}, "[points] that a covariance is made of");
  v("lambda", o.lambda, Bounds{1e-12, 1}, "[m^2] added to the diagonal of every covariance");
  v("neighborhood", o.neighborhood, "[-] of a feature: its neighbours in the filtered scan, or among the features");
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a point and its match");
  v("predict", o.predict, "[-] begin at the pose expected at constant velocity, as FLOAM does; false: at the last one");
  v("align", o.align, "[-] iterations of the registration");
  v("edge_map", o.edge_map, "[-] local map of edges");
  v("plane_map", o.plane_map, "[-] local map of planes");
}

struct PrintedFeatures {
  GaussianPoints edges, planes;
};

/// Of each sector of a ring of a filtered scan the points of greatest and of least corrected curvature.
PrintedFeatures printed_features(const PointCloud& filtered, const Fu2026Options& options);

/// Where the points lie in the map.
std::vector<Eigen::Vector3d> moved(const GaussianPoints& points, const Pose& T_map_lidar);

class Fu2026 : public Odometry {
 public:
  explicit Fu2026(const Fu2026Options& options)
      : options_(options), outliers_(options.outliers), edge_map_(options.edge_map), plane_map_(options.plane_map) {}
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  AlignResult register_features(const PrintedFeatures& features, const Pose& T_start) const;
  void insert(const PrintedFeatures& features, const Pose& T_world_lidar);

  Fu2026Options options_;
  OutlierFilter outliers_;
  RingLayout rings_;  // of the scan
  ConstantVelocity motion_;
  CroppedMap edge_map_, plane_map_;
};

}  // namespace tilth
