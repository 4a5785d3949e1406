// LIO-SAM (Shan, Englot, Meyers, Wang, Ratti and Rus, IROS 2020) with the LiDAR alone: its scan-to-map registration and
// its keyframes. Nothing takes the place of the IMU unless options say so: then it is constant velocity.
#pragma once

#include <tilth/features/lio_sam_features.hpp>
#include <tilth/map/keyframe_map.hpp>
#include <tilth/odometry/motion_model.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/registration/align.hpp>
#include <tilth/registration/line_plane_association.hpp>
#include <tilth/search/searchable_cloud.hpp>

namespace tilth {

struct LioSamOptions {
  double max_range = 1000.0;
  bool predict = false;
  bool deskew = false;
  double pose_at = 0.5;
  double mapping_interval = 0.0;
  LioSamFeatureOptions features;
  double edge_voxel = 0.1;
  double plane_voxel = 0.2;
  LinePlaneOptions association{.weight_slope = 0.9};
  AlignOptions align{.max_iterations = 30,
                     .transformation_epsilon = 5e-4,
                     .rotation_epsilon = 8.7266e-4,
                     .fitness_epsilon = 0,
                     .min_information = 100,
                     .min_matches = 50};
  double keyframe_distance = 1.0;
  double keyframe_angle = 0.2;
  KeyframeMapOptions map{.density = 2.0, .recent = 10.0};
};

template <class V>
void visit(LioSamOptions& o, V&& v) {
  v("max_range", o.max_range, Bounds{0.1, 1e4},
    "[m] farther points are dropped; nearer ones: features.image.min_range");
  v("predict", o.predict,
    "[-] registration begins at constant velocity; false: at the last pose, as LIO-SAM without an IMU");
  v("deskew", o.deskew, "[-] undo the motion within a scan, at constant velocity, where points have times");
  v("pose_at", o.pose_at, Bounds{0, 1}, "[-] instant of the pose within the scan: 0 its first point, 1 its last one");
  v("mapping_interval", o.mapping_interval, Bounds{0, 1e3},
    "[s] scans that come sooner after the last registered one are only predicted; LIO-SAM: 0.15");
  v("features", o.features, "[-] edge and plane features");
  v("edge_voxel", o.edge_voxel, Bounds{0.01, 100}, "[m] grid of the edges of the scan and of the map");
  v("plane_voxel", o.plane_voxel, Bounds{0.01, 100}, "[m] grid of the planes of the scan and of the map");
  v("association", o.association, "[-] scan to map");
  v("align", o.align, "[-] iterations of the registration");
  v("keyframe_distance", o.keyframe_distance, Bounds{0, 1e4}, "[m] from the last keyframe that makes a new one");
  v("keyframe_angle", o.keyframe_angle, Bounds{0, 3.15}, "[rad] from the last keyframe that makes a new one");
  v("map", o.map, "[-] keyframes that a scan is registered to");
}

class LioSam : public Odometry {
 public:
  explicit LioSam(const LioSamOptions& options) : options_(options), map_(options.map) {}
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  AlignResult register_features(const FeatureClouds& features, const Pose& T_start) const;
  void add_keyframe(const FeatureClouds& features, double stamp, const Pose& T_world_lidar);
  void gather_map(double stamp);

  LioSamOptions options_;
  ConstantVelocity motion_;
  KeyframeMap map_;
  std::vector<std::uint32_t> keyframes_;  // of which the next two clouds are made
  SearchableCloud map_edges_{{}}, map_planes_{{}};
};

}  // namespace tilth
