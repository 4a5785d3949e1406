#include <algorithm>

#include <tilth/core/voxel_downsample.hpp>
#include <tilth/odometry/floam.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

constexpr std::size_t kLeastMapEdges = 10, kLeastMapPlanes = 50;  // more must be there

}  // namespace

OdometryResult Floam::register_scan(const Scan& scan) {
  OdometryResult result;
  begin_stage("crop");
  PointCloud cloud = crop_range(scan.cloud, options_.min_range, options_.max_range);
  const std::size_t points_in = cloud.size();
  const double scan_duration = duration(cloud), instant = options_.pose_at * scan_duration;
  result.stamp = scan.stamp + instant;
  result.filtered = filtered(std::move(cloud));
  begin_stage("features");
  FeatureClouds features = floam_features(result.filtered, options_.features);
  if (options_.deskew) {
    result.motion = {.velocity = motion_.velocity(), .begin = -instant, .duration = scan_duration};
    features.edges = deskew(std::move(features.edges), result.motion, instant);
    features.planes = deskew(std::move(features.planes), result.motion, instant);
  }
  const FeatureClouds sparse{voxel_downsample(features.edges, options_.edge_map.voxel_size),
                             voxel_downsample(features.planes, options_.plane_map.voxel_size)};

  begin_stage("registration");
  const bool is_first = edge_map_.cloud().size() + plane_map_.cloud().size() == 0;
  result.alignment = register_features(sparse, motion_.predict(result.stamp));
  result.T_world_lidar = result.alignment.T_target_source;
  begin_stage("map");
  motion_.update(result.stamp, result.T_world_lidar);
  if (is_first) {
    edge_map_.reset(transform(features.edges, result.T_world_lidar).points);
    plane_map_.reset(transform(features.planes, result.T_world_lidar).points);
    result.alignment.converged = !features.planes.empty();
  } else {
    insert(sparse, result.T_world_lidar);
  }
  result.counts = {points_in, points_in - result.filtered.size(), features.edges.size(), features.planes.size()};
  return result;
}

PointCloud Floam::filtered(PointCloud cloud) {
  if (options_.outliers.method == OutlierMethod::none) return cloud;
  begin_stage("outliers");
  arrange(cloud, rings_);
  return select_kept(cloud, outliers_.keep(cloud, rings_));
}

AlignResult Floam::register_features(const FeatureClouds& features, const Pose& T_start) const {
  const SearchableCloud &edges = edge_map_.cloud(), &planes = plane_map_.cloud();
  AlignResult result = unmatched(T_start);
  if (edges.size() > kLeastMapEdges && planes.size() > kLeastMapPlanes) {
    AlignOptions schedule = options_.align;
    schedule.max_iterations = std::max(schedule.max_iterations, options_.first_iterations - motion_.updates());
    const auto lines_at = [&](const Pose& T) {
      return associate_lines(features.edges.points, T, edges, options_.association);
    };
    const auto planes_at = [&](const Pose& T) {
      return associate_planes(features.planes.points, T, planes, options_.association);
    };
    result = align(T_start, schedule, lines_at, planes_at);
    // The schedule ends by count: what it has ended with counts as found.
    result.converged |=
        result.iterations == schedule.max_iterations && result.matches >= std::size_t(schedule.min_matches);
  }
  result.candidates = features.edges.size() + features.planes.size();
  return result;
}

void Floam::insert(const FeatureClouds& features, const Pose& T_world_lidar) {
  edge_map_.insert(transform(features.edges, T_world_lidar).points, T_world_lidar.translation());
  plane_map_.insert(transform(features.planes, T_world_lidar).points, T_world_lidar.translation());
}

PointCloud Floam::local_map() const {
  return points_of(edge_map_, plane_map_);
}

}  // namespace tilth
