#include <tilth/features/edge_plane.hpp>
#include <tilth/odometry/fu2026.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/search/neighbor_moments.hpp>

namespace tilth {
namespace {

GaussianPoints gaussians(const PointCloud& filtered, const LocalCovariances& local,
                         const std::vector<std::uint32_t>& chosen, const Fu2026Options& options) {
  GaussianPoints points;
  for (const std::uint32_t i : chosen) points.means.push_back(filtered.points[i]);
  if (options.neighborhood == Neighborhood::features)
    return gaussians_among(points.means, options.neighbors, options.lambda);
  for (const std::uint32_t i : chosen)
    points.covariances.push_back(local.matrix(i).cast<double>() + options.lambda * Eigen::Matrix3d::Identity());
  return points;
}

}  // namespace

PrintedFeatures printed_features(const PointCloud& filtered, const Fu2026Options& options) {
  const NeighborTable neighbors = scan_neighbors(filtered, std::size_t(options.neighbors));
  const LocalCovariances local = local_covariances(filtered, neighbors);
  std::vector<double> curvature(filtered.size());
  for (std::size_t i = 0; i < curvature.size(); ++i) curvature[i] = double(corrected_curvature(local.matrix(i)));
  const FloamFeatureOptions choice{.min_ring_points = options.min_ring_points,
                                   .edge_threshold = 0,  // the text has none
                                   .edges = options.edges,
                                   .planes = options.planes};
  const FeatureIndices chosen = choose_floam_features(filtered, curvature, choice);
  return {gaussians(filtered, local, chosen.edges, options), gaussians(filtered, local, chosen.planes, options)};
}

std::vector<Eigen::Vector3d> moved(const GaussianPoints& gaussians, const Pose& T_map_lidar) {
  std::vector<Eigen::Vector3d> in_map;
  in_map.reserve(gaussians.means.size());
  for (const Eigen::Vector3d& p : gaussians.means) in_map.push_back(T_map_lidar * p);
  return in_map;
}

OdometryResult Fu2026::register_scan(const Scan& scan) {
  OdometryResult result;
  begin_stage("crop");
  const PointCloud cloud = crop_range(scan.cloud, options_.min_range, options_.max_range);
  begin_stage("outliers");
  arrange(cloud, rings_);
  result.filtered = select_kept(cloud, outliers_.keep(cloud, rings_));
  begin_stage("features");
  const PrintedFeatures features = printed_features(result.filtered, options_);

  begin_stage("registration");
  result.stamp = scan.stamp + options_.pose_at * duration(cloud);
  const Pose T_start = options_.predict ? motion_.predict(result.stamp) : motion_.last_pose();
  result.alignment = register_features(features, T_start);
  result.T_world_lidar = result.alignment.T_target_source;
  begin_stage("map");
  motion_.update(result.stamp, result.T_world_lidar);
  insert(features, result.T_world_lidar);
  result.counts = {cloud.size(), cloud.size() - result.filtered.size(), features.edges.means.size(),
                   features.planes.means.size()};
  return result;
}

AlignResult Fu2026::register_features(const PrintedFeatures& features, const Pose& T_start) const {
  const SearchableCloud &edges = edge_map_.cloud(), &planes = plane_map_.cloud();
  AlignResult result = unmatched(T_start);
  if (motion_.updates() == 0) {
    result.converged = !features.planes.means.empty();
  } else {
    NeighborhoodGaussians edge_target(edges, options_.neighbors, options_.lambda);
    NeighborhoodGaussians plane_target(planes, options_.neighbors, options_.lambda);
    const auto edges_at = [&](const Pose& T) {
      return associate_gaussians(features.edges, T, edge_target, options_.max_distance);
    };
    const auto planes_at = [&](const Pose& T) {
      return associate_gaussians(features.planes, T, plane_target, options_.max_distance);
    };
    result = align(T_start, options_.align, edges_at, planes_at);
  }
  result.candidates = features.edges.means.size() + features.planes.means.size();
  return result;
}

void Fu2026::insert(const PrintedFeatures& features, const Pose& T_world_lidar) {
  const Eigen::Vector3d center = T_world_lidar.translation();
  edge_map_.insert(moved(features.edges, T_world_lidar), center);
  plane_map_.insert(moved(features.planes, T_world_lidar), center);
}

PointCloud Fu2026::local_map() const {
  return points_of(edge_map_, plane_map_);
}

}  // namespace tilth
