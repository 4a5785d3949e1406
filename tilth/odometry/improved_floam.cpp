#include <algorithm>

#include <tilth/odometry/improved_floam.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/search/neighbor_moments.hpp>

namespace tilth {
namespace {

// [s] from the stamp to the middle of the scan: the instant that a wrong velocity shifts least.
double middle_of(const PointCloud& cloud) {
  return cloud.has_times() ? 0.5 * double(*std::max_element(cloud.times.begin(), cloud.times.end())) : 0.0;
}

PointCloud with_covariances(PointCloud cloud, std::span<const std::uint32_t> indices, const LocalCovariances& sigma) {
  cloud.covariances.reserve(indices.size());
  for (const std::uint32_t i : indices) cloud.covariances.push_back(sigma.matrix(i).cast<double>());
  return cloud;
}

// kappa of every point, 0 for outliers.
std::vector<float> curvatures(const LocalCovariances& sigma, std::span<const std::uint8_t> keep) {
  std::vector<float> kappa(sigma.size());
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    kappa[i] = keep[i] ? corrected_curvature(sigma.matrix(i)) : 0;
  }
  return kappa;
}

std::vector<std::uint32_t> every(std::size_t stride, std::span<const std::uint8_t> keep) {
  std::vector<std::uint32_t> indices;
  std::size_t seen = 0;
  for (std::uint32_t i = 0; i < keep.size(); ++i) {
    if (keep[i] && seen++ % stride == 0) indices.push_back(i);
  }
  return indices;
}

// The first alignment only has to bring the pose within reach of the second.
AlignOptions approach(AlignOptions options) {
  options.transformation_epsilon = std::max(options.transformation_epsilon, 1e-3);
  return options;
}

}  // namespace

ImprovedFloam::ImprovedFloam(const ImprovedFloamOptions& options)
    : options_(options), edge_map_(options.edge_map), plane_map_(options.plane_map), wide_map_(options.wide_map) {}

OdometryResult ImprovedFloam::register_scan(const Scan& scan) {
  begin_stage("crop");
  const PointCloud cloud = crop_range(scan.cloud, options_.min_range, options_.max_range);
  begin_stage("neighbors");
  const NeighborTable& neighbors = neighbors_.compute(cloud, std::size_t(options_.outliers.k));
  begin_stage("outliers");
  const std::vector<std::uint8_t> keep = keep_inliers(cloud, neighbors, options_.outliers);
  begin_stage("features");
  const LocalCovariances& sigma = moments_.compute(cloud, neighbors, keep);
  const FeatureIndices features = select_features(cloud, curvatures(sigma, keep), options_.features);

  begin_stage("deskew");
  const double middle = middle_of(cloud);
  const Vector6d velocity = options_.deskew ? motion_.velocity() : Vector6d::Zero();
  const auto still = [&](std::span<const std::uint32_t> indices) {
    return deskew(with_covariances(select(cloud, indices), indices, sigma), velocity, middle);
  };
  const PointCloud edges = still(features.edges), planes = still(features.planes);

  begin_stage("registration");
  OdometryResult result;
  result.alignment = register_features(edges, planes, motion_.predict(scan.stamp + middle));
  begin_stage("map");
  const Pose& T_world_middle = result.alignment.T_target_source;
  motion_.update(scan.stamp + middle, T_world_middle);
  const std::vector<std::uint32_t> mapped = every(std::size_t(options_.map_stride), keep);
  insert(edges, deskew(select(cloud, mapped), velocity, middle), T_world_middle);

  result.velocity = motion_.velocity();
  result.stamp = scan.stamp + middle;
  result.T_world_lidar = T_world_middle;
  result.counts = {cloud.size(), std::size_t(std::count(keep.begin(), keep.end(), 0)), edges.size(), planes.size()};
  result.filtered = select(cloud, every(1, keep));
  return result;
}

AlignResult ImprovedFloam::register_features(const PointCloud& edges, const PointCloud& planes,
                                             const Pose& T_predicted) const {
  if (motion_.updates() == 0) return {.T_target_source = T_predicted, .converged = true};
  const auto align_by = [&](const auto& associate) {
    const auto to = [&](const PointCloud& features, const GaussianMap& map) {
      const auto find = [&map](const Eigen::Vector3d& p) { return map.find_nearest(p); };
      return [&, find](const Pose& T) { return associate(features, T, find, options_.association); };
    };
    if (motion_.updates() < options_.wide_scans) return align(T_predicted, options_.align, to(planes, wide_map_));
    const AlignResult wide = align(T_predicted, approach(options_.align), to(planes, wide_map_));
    AlignResult fine = align(wide.T_target_source, options_.align, to(edges, edge_map_), to(planes, plane_map_));
    fine.iterations += wide.iterations;
    return fine;
  };
  AlignResult result = options_.method == RegistrationMethod::gicp
                           ? align_by([](const auto&... args) { return associate_distributions(args...); })
                           : align_by([](const auto&... args) { return associate_points(args...); });
  result.candidates = edges.size() + planes.size();
  return result;
}

void ImprovedFloam::insert(const PointCloud& edges, const PointCloud& surfaces, const Pose& T_world_lidar) {
  const std::vector<Eigen::Vector3d> surfaces_in_world = transform(surfaces, T_world_lidar).points;
  edge_map_.insert(transform(edges, T_world_lidar).points);
  plane_map_.insert(surfaces_in_world);
  wide_map_.insert(surfaces_in_world);
  for (GaussianMap* map : {&edge_map_, &plane_map_, &wide_map_}) map->crop(T_world_lidar.translation());
}

PointCloud ImprovedFloam::local_map() const {
  PointCloud map_in_world;
  for (const GaussianMap* map : {&edge_map_, &plane_map_}) {
    for (const GaussianVoxel& voxel : map->voxels()) map_in_world.points.push_back(voxel.mean);
  }
  return map_in_world;
}

}  // namespace tilth
