// LeGO-LOAM with the LiDAR alone (Shan and Englot, IROS 2018), as its authors ship it for the VLP-16: ground and
// clusters of a range image; scan to scan in two steps; scan to map against keyframes on every fourth scan. Loop
// closure, off in the original, stands outside.
#pragma once

#include <tilth/features/lego_features.hpp>
#include <tilth/map/keyframe_map.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/registration/line_plane_association.hpp>
#include <tilth/registration/scan_to_scan.hpp>

namespace tilth {

enum class PointTimeSource { azimuth, measured, none };
inline std::span<const std::string_view> names_of(PointTimeSource) {
  static constexpr std::array<std::string_view, 3> names{"azimuth", "measured", "none"};
  return names;
}

struct LegoMappingOptions {
  int every = 2;
  double interval = 0.3;
  double edge_voxel = 0.2;
  double plane_voxel = 0.4;
  double keyframe_distance = 0.3;
  KeyframeMapOptions keyframes;
  LinePlaneOptions association{.weight_slope = 0.9};
  AlignOptions align{.max_iterations = 10,
                     .transformation_epsilon = 5e-4,
                     .rotation_epsilon = 8.7266e-4,
                     .fitness_epsilon = 0,
                     .min_information = 100,
                     .min_matches = 50};
};

template <class V>
void visit(LegoMappingOptions& o, V&& v) {
  v("every", o.every, Bounds{1, 1000}, "[scans] of which one is offered to the mapping");
  v("interval", o.interval, Bounds{0, 1e4}, "[s] since the last one mapped, at least");
  v("edge_voxel", o.edge_voxel, Bounds{0.01, 100}, "[m] grid of edge points");
  v("plane_voxel", o.plane_voxel, Bounds{0.01, 100}, "[m] grid of plane points, and of outliers, which join them");
  v("keyframe_distance", o.keyframe_distance, Bounds{0, 1e4}, "[m] from the last keyframe to the next one, at least");
  v("keyframes", o.keyframes, "[-] which keyframes make the local map");
  v("association", o.association, "[-] scan to map");
  v("align", o.align, "[-] scan to map");
}

struct LegoLoamOptions {
  double scan_period = 0.1;
  PointTimeSource point_times = PointTimeSource::azimuth;
  bool stamp_at_start = false;
  SegmentationOptions segmentation;
  LegoFeatureOptions features;
  ScanToScanOptions scan_to_scan;
  LegoMappingOptions mapping;
};

template <class V>
void visit(LegoLoamOptions& o, V&& v) {
  v("scan_period", o.scan_period, Bounds{1e-3, 10}, "[s] of a turn, where points have no times");
  v("point_times", o.point_times,
    "[-] the motion within a scan is undone by times from the azimuth, as the original; by the times measured, where "
    "there are any; or not at all");
  v("stamp_at_start", o.stamp_at_start,
    "[-] as LeGO-LOAM: the pose, which is that of the end of the scan, is stamped with its start", kAdvanced);
  v("segmentation", o.segmentation, "[-] range image, ground and clusters");
  v("features", o.features, "[-] edge and plane points");
  v("scan_to_scan", o.scan_to_scan, "[-] scan to scan, in two steps");
  v("mapping", o.mapping, "[-] scan to map");
}

class LegoLoam : public Odometry {
 public:
  explicit LegoLoam(const LegoLoamOptions& options) : options_(options), map_(options.mapping.keyframes) {}

  /// The pose is that of the scan's end.
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  bool is_mapping_due(double stamp) const;
  void map_scan(const FeatureClouds& features, double stamp, AlignResult& alignment);
  void add_keyframe(const FeatureClouds& features, double stamp);
  Pose T_world_end() const { return normalized(T_world_odom_ * T_odom_end_); }

  LegoLoamOptions options_;
  KeyframeMap map_;
  ScanTargets last_scan_;
  Pose T_start_end_ = Pose::Identity();   // motion during the last scan
  Pose T_odom_end_ = Pose::Identity();    // scan by scan
  Pose T_world_odom_ = Pose::Identity();  // as the last mapping found it
  std::size_t scans_ = 0;
  double last_mapping_ = 0.0;  // [s]
};

}  // namespace tilth
