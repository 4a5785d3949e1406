#include <tilth/core/voxel_downsample.hpp>
#include <tilth/odometry/lio_sam.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

constexpr std::size_t kLeastEdges = 10, kLeastPlanes = 100;  // of the scan; more must be there

}  // namespace

OdometryResult LioSam::register_scan(const Scan& scan) {
  OdometryResult result;
  begin_stage("crop");
  result.filtered = crop_range(scan.cloud, options_.features.image.min_range, options_.max_range);
  begin_stage("features");
  FeatureClouds features = lio_sam_features(result.filtered, options_.features);
  result.counts = {result.filtered.size(), 0, features.edges.size(), features.planes.size()};

  begin_stage("deskew");
  const double scan_duration = duration(result.filtered), instant = options_.pose_at * scan_duration;
  result.stamp = scan.stamp + instant;
  if (options_.deskew) result.motion = {.velocity = motion_.velocity(), .begin = -instant, .duration = scan_duration};
  features.edges = voxel_downsample(deskew(features.edges, result.motion, instant), options_.edge_voxel);
  features.planes = voxel_downsample(deskew(features.planes, result.motion, instant), options_.plane_voxel);

  begin_stage("registration");
  const Pose T_predicted = motion_.predict(result.stamp);
  const bool is_due = motion_.updates() == 0 || result.stamp - motion_.last_time() >= options_.mapping_interval;
  result.alignment = unmatched(T_predicted);
  if (is_due) result.alignment = register_features(features, options_.predict ? T_predicted : motion_.last_pose());
  result.T_world_lidar = result.alignment.T_target_source;
  result.alignment.candidates = features.edges.size() + features.planes.size();
  result.in_map = is_due;
  if (!is_due) return result;
  begin_stage("map");
  result.alignment.converged |= map_.empty() && !features.planes.empty();
  motion_.update(result.stamp, result.T_world_lidar);
  add_keyframe(features, result.stamp, result.T_world_lidar);
  gather_map(result.stamp);
  return result;
}

AlignResult LioSam::register_features(const FeatureClouds& features, const Pose& T_start) const {
  if (map_.empty() || features.edges.size() <= kLeastEdges || features.planes.size() <= kLeastPlanes)
    return unmatched(T_start);
  const auto lines_at = [&](const Pose& T) {
    return associate_lines(features.edges.points, T, map_edges_, options_.association);
  };
  const auto planes_at = [&](const Pose& T) {
    return associate_planes(features.planes.points, T, map_planes_, options_.association);
  };
  return align(T_start, options_.align, lines_at, planes_at);
}

void LioSam::add_keyframe(const FeatureClouds& features, double stamp, const Pose& T_world_lidar) {
  if (features.planes.empty()) return;
  if (!map_.empty()) {
    const Pose motion = map_.last_pose().inverse() * T_world_lidar;
    if (motion.translation().norm() < options_.keyframe_distance && angle_of(motion) < options_.keyframe_angle) return;
  }
  map_.insert(stamp, T_world_lidar, features);
}

void LioSam::gather_map(double stamp) {
  if (map_.empty()) return;
  std::vector<std::uint32_t> keyframes = map_.surrounding(map_.last_pose().translation(), stamp);
  if (keyframes == keyframes_) return;
  const FeatureClouds joined = map_.joined(keyframes);
  map_edges_ = SearchableCloud(voxel_downsample(joined.edges, options_.edge_voxel).points);
  map_planes_ = SearchableCloud(voxel_downsample(joined.planes, options_.plane_voxel).points);
  keyframes_ = std::move(keyframes);
}

PointCloud LioSam::local_map() const {
  FeatureClouds map = map_.joined(keyframes_);
  append(map.edges, map.planes);
  return map.edges;
}

}  // namespace tilth
