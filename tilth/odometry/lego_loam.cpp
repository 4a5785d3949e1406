#include <limits>

#include <tilth/core/voxel_downsample.hpp>
#include <tilth/odometry/lego_loam.hpp>
#include <tilth/preprocess/azimuth_times.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/search/searchable_cloud.hpp>

namespace tilth {
namespace {

constexpr double kAnyRange = std::numeric_limits<double>::max();
constexpr std::size_t kLeastMapEdges = 10, kLeastMapPlanes = 100;  // more must be there

// [s] of the scan.
double period_of(const PointCloud& cloud, const LegoLoamOptions& options) {
  return duration(cloud) > 0 ? duration(cloud) : options.scan_period;
}

std::vector<float> times_of(const PointCloud& cloud, const LegoLoamOptions& options) {
  switch (options.point_times) {
    case PointTimeSource::azimuth: return azimuth_times(cloud, period_of(cloud, options));
    case PointTimeSource::measured: return cloud.times;
    case PointTimeSource::none: break;
  }
  return {};
}

// Features on the grids of the map. Outliers join the planes.
FeatureClouds gridded(const FeatureClouds& features, const PointCloud& outliers, const LegoMappingOptions& options) {
  FeatureClouds sparse{voxel_downsample(features.edges, options.edge_voxel),
                       voxel_downsample(features.planes, options.plane_voxel)};
  append(sparse.planes, voxel_downsample(outliers, options.plane_voxel));
  return sparse;
}

}  // namespace

OdometryResult LegoLoam::register_scan(const Scan& scan) {
  OdometryResult result;
  begin_stage("crop");
  PointCloud cloud = crop_range(scan.cloud, 0, kAnyRange);
  const double period = period_of(cloud, options_);
  cloud.times = times_of(cloud, options_);
  cloud = crop_range(cloud, options_.segmentation.image.min_range, kAnyRange);
  begin_stage("segmentation");
  const SegmentedScan segmented = segment(cloud, options_.segmentation);
  result.filtered = select_kept(cloud, segmented.keep);
  begin_stage("features");
  const LegoFeatures features = lego_features(segmented, options_.features);

  begin_stage("scan_to_scan");
  result.alignment =
      align_scan_to_scan({features.sharp, features.flat, period}, last_scan_, T_start_end_, options_.scan_to_scan);
  T_start_end_ = result.alignment.T_target_source;
  T_odom_end_ = normalized(T_odom_end_ * T_start_end_);
  if (cloud.has_times()) result.motion = {.velocity = log(T_start_end_) / period, .begin = -period, .duration = period};
  const auto at_end = [&](const PointCloud& points) { return deskew(points, result.motion, period); };
  const FeatureClouds still{at_end(features.less_sharp), at_end(features.less_flat)};
  last_scan_ = {ScanTarget(still.edges), ScanTarget(still.planes)};

  const bool is_first = map_.empty();
  if (is_mapping_due(scan.stamp)) {
    begin_stage("mapping");
    map_scan(gridded(still, at_end(segmented.outliers), options_.mapping), scan.stamp, result.alignment);
  }
  ++scans_;
  result.alignment.converged |= is_first && !map_.empty();
  result.alignment.T_target_source = result.T_world_lidar = T_world_end();
  result.stamp = scan.stamp + (cloud.has_times() && !options_.stamp_at_start ? period : 0.0);
  result.counts = {cloud.size(), cloud.size() - result.filtered.size(), still.edges.size(), still.planes.size()};
  return result;
}

bool LegoLoam::is_mapping_due(double stamp) const {
  const LegoMappingOptions& mapping = options_.mapping;
  return scans_ % std::size_t(mapping.every) == 0 && (map_.empty() || stamp - last_mapping_ >= mapping.interval);
}

void LegoLoam::map_scan(const FeatureClouds& features, double stamp, AlignResult& alignment) {
  const LegoMappingOptions& mapping = options_.mapping;
  const Pose T_guess = T_world_end();
  const FeatureClouds map = map_.joined(map_.surrounding(T_guess.translation(), stamp));
  const SearchableCloud edges(voxel_downsample(map.edges, mapping.edge_voxel).points);
  const SearchableCloud planes(voxel_downsample(map.planes, mapping.plane_voxel).points);
  if (edges.size() > kLeastMapEdges && planes.size() > kLeastMapPlanes) {
    const PointCloud scan_planes = voxel_downsample(features.planes, mapping.plane_voxel);
    const auto lines_at = [&](const Pose& T) {
      return associate_lines(features.edges.points, T, edges, mapping.association);
    };
    const auto planes_at = [&](const Pose& T) {
      return associate_planes(scan_planes.points, T, planes, mapping.association);
    };
    alignment = align(T_guess, mapping.align, lines_at, planes_at);
    alignment.candidates = features.edges.size() + scan_planes.size();
    T_world_odom_ = normalized(alignment.T_target_source * T_odom_end_.inverse());
  }
  last_mapping_ = stamp;
  add_keyframe(features, stamp);
}

void LegoLoam::add_keyframe(const FeatureClouds& features, double stamp) {
  if (features.planes.empty()) return;
  const Eigen::Vector3d position = T_world_end().translation();
  if (map_.empty() || (position - map_.last_pose().translation()).norm() > options_.mapping.keyframe_distance)
    map_.insert(stamp, T_world_end(), features);
}

PointCloud LegoLoam::local_map() const {
  FeatureClouds map = map_.joined(map_.surrounding(T_world_end().translation(), last_mapping_));
  append(map.edges, map.planes);
  return map.edges;
}

}  // namespace tilth
