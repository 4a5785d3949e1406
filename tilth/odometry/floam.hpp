// FLOAM: Wang, Wang, Chen and Xie, IROS 2021, as its authors' program does it for a sensor of 16 beams.
#pragma once

#include <tilth/features/floam_features.hpp>
#include <tilth/map/cropped_map.hpp>
#include <tilth/odometry/motion_model.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/preprocess/outlier_removal.hpp>
#include <tilth/registration/align.hpp>
#include <tilth/registration/line_plane_association.hpp>

namespace tilth {

struct FloamOptions {
  double min_range = 0.5;
  double max_range = 90.0;
  double pose_at = 0.5;
  OutlierOptions outliers{.method = OutlierMethod::none};
  bool deskew = false;
  FloamFeatureOptions features;
  LinePlaneOptions association;
  int first_iterations = 12;
  AlignOptions align{.max_iterations = 2,
                     .inner_iterations = 4,
                     .kernel = Kernel::huber,
                     .kernel_width = 0.1,
                     .damping = 1e-4,
                     .min_matches = 6};
  CroppedMapOptions edge_map{.voxel_size = 0.2};
  CroppedMapOptions plane_map{.voxel_size = 0.4};
};

template <class V>
void visit(FloamOptions& o, V&& v) {
  v("min_range", o.min_range, Bounds{0, 1e4}, "[m] nearer points are dropped");
  v("max_range", o.max_range, Bounds{0.1, 1e4}, "[m] farther points are dropped");
  v("pose_at", o.pose_at, Bounds{0, 1},
    "[-] instant that a pose is stamped with: 0 the scan's first point, as FLOAM does, 1 its last one; the scan is not "
    "deskewed, so its middle fits best");
  v("outliers", o.outliers, "[-] outlier removal, which FLOAM has none of", kAdvanced);
  v("deskew", o.deskew, "[-] undo the motion within a scan, at the velocity of the last one; FLOAM does not",
    kAdvanced);
  v("features", o.features, "[-] edge and plane features");
  v("association", o.association, "[-] scan to map");
  v("first_iterations", o.first_iterations, Bounds{1, 10000},
    "[-] associations of the first scan; one less with each scan, down to align.max_iterations", kAdvanced);
  v("align", o.align, "[-] iterations of the registration");
  v("edge_map", o.edge_map, "[-] local map of edges");
  v("plane_map", o.plane_map, "[-] local map of planes");
}

class Floam : public Odometry {
 public:
  explicit Floam(const FloamOptions& options)
      : options_(options), outliers_(options.outliers), edge_map_(options.edge_map), plane_map_(options.plane_map) {}
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  PointCloud filtered(PointCloud cloud);
  AlignResult register_features(const FeatureClouds& features, const Pose& T_start) const;
  void insert(const FeatureClouds& features, const Pose& T_world_lidar);

  FloamOptions options_;
  OutlierFilter outliers_;
  RingLayout rings_;  // of the scan
  ConstantVelocity motion_;
  CroppedMap edge_map_, plane_map_;
};

}  // namespace tilth
