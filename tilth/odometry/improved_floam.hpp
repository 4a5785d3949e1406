// FLOAM with statistical outlier removal and GICP: Fu et al., Appl. Sci. 2026, 16, 3141.
#pragma once

#include <tilth/features/edge_plane.hpp>
#include <tilth/map/gaussian_map.hpp>
#include <tilth/odometry/motion_model.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/preprocess/outlier_removal.hpp>
#include <tilth/registration/align.hpp>
#include <tilth/registration/association.hpp>
#include <tilth/search/neighbor_moments.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

enum class RegistrationMethod { gicp, icp };
inline std::span<const std::string_view> names_of(RegistrationMethod) {
  static constexpr std::array<std::string_view, 2> names{"gicp", "icp"};
  return names;
}

struct ImprovedFloamOptions {
  double min_range = 0.5;
  double max_range = 100.0;
  bool deskew = true;
  OutlierOptions outliers;
  FeatureOptions features;
  int map_stride = 2;
  RegistrationMethod method = RegistrationMethod::gicp;
  AssociationOptions association;
  AlignOptions align;
  GaussianMapOptions edge_map{.voxel_size = 1.0};
  GaussianMapOptions plane_map;
  GaussianMapOptions wide_map{.voxel_size = 1.0};
  int wide_scans = 15;
};

template <class V>
void visit(ImprovedFloamOptions& o, V&& v) {
  v("min_range", o.min_range, Bounds{0, 1e4}, "[m] nearer points are dropped");
  v("max_range", o.max_range, Bounds{0.1, 1e4}, "[m] farther points are dropped");
  v("deskew", o.deskew, "[-] undo the motion within a scan, where points have times");
  v("outliers", o.outliers, "[-] statistical outlier removal");
  v("features", o.features, "[-] edge and plane points");
  v("map_stride", o.map_stride, Bounds{1, 1000}, "[points] every n-th filtered point is added to the plane map");
  v("method", o.method, "[-] gicp: distribution to distribution; icp: point to point");
  v("association", o.association, "[-] scan to map");
  v("align", o.align, "[-] iterations of the registration");
  v("edge_map", o.edge_map, "[-] local map of edges");
  v("plane_map", o.plane_map, "[-] local map of planes");
  v("wide_map", o.wide_map, "[-] the same in larger voxels, which the scan is aligned to first: it reaches farther");
  v("wide_scans", o.wide_scans, Bounds{0, 1e6},
    "[scans] at the start that use the wide map alone: most small voxels have met one beam only");
}

class ImprovedFloam : public Odometry {
 public:
  explicit ImprovedFloam(const ImprovedFloamOptions& options);
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  AlignResult register_features(const PointCloud& edges, const PointCloud& planes, const Pose& T_predicted) const;
  void insert(const PointCloud& edges, const PointCloud& surfaces, const Pose& T_world_lidar);

  ImprovedFloamOptions options_;
  ScanNeighbors neighbors_;
  NeighborMoments moments_;
  ConstantVelocity motion_;
  GaussianMap edge_map_, plane_map_, wide_map_;
};

}  // namespace tilth
