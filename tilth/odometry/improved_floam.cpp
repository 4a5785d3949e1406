#include <algorithm>

#include <tilth/odometry/improved_floam.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

SurfacePatches joined(SurfacePatches a, const SurfacePatches& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

AlignOptions rough(const ImprovedFloamOptions& options) {
  AlignOptions align = options.align;
  align.kernel_width = std::max(options.first_kernel_width, align.kernel_width);
  align.transformation_epsilon = std::max(options.first_epsilon, align.transformation_epsilon);
  align.rotation_epsilon = std::max(options.first_epsilon, align.rotation_epsilon);
  return align;
}

}  // namespace

OdometryResult ImprovedFloam::register_scan(const Scan& scan) {
  OdometryResult result;
  begin_stage("crop");
  const PointCloud cloud = crop_range(scan.cloud, options_.min_range, options_.max_range);
  begin_stage("outliers");
  arrange(cloud, rings_);
  const std::vector<std::uint8_t>& keep = outliers_.keep(cloud, rings_);
  result.filtered = select_kept(cloud, keep);
  begin_stage("features");
  SurfacePatches patches = surface_patches(cloud, rings_, keep, options_.patches);
  const PatchFeatures features = patch_features(patches, options_.features);

  begin_stage("registration");
  const double middle = 0.5 * duration(cloud);
  result.stamp = scan.stamp + middle;
  // The second time the scan is straightened by the motion that the first time, which may be rough, has found.
  Pose T_world_middle = motion_.predict(result.stamp);
  MatchedPatches<MapSurface> still;
  for (const AlignOptions& align : {rough(options_), options_.align}) {
    if (options_.deskew)
      result.motion = MotionInScan::steady(motion_.velocity_to(result.stamp, T_world_middle), middle);
    still.patches = deskew(joined(features.edges, features.planes), result.motion, middle);
    result.alignment = register_features(still, T_world_middle, align);
    T_world_middle = result.alignment.T_target_source;
  }
  begin_stage("map");
  motion_.update(result.stamp, T_world_middle);
  map_.insert(deskew(std::move(patches), result.motion, middle), T_world_middle);
  map_.crop(T_world_middle.translation());

  result.T_world_lidar = T_world_middle;
  result.counts = {cloud.size(), cloud.size() - result.filtered.size(), features.edges.size(), features.planes.size()};
  return result;
}

AlignResult ImprovedFloam::register_features(MatchedPatches<MapSurface>& features, const Pose& T_start,
                                             const AlignOptions& align_options) const {
  if (motion_.updates() == 0) return {.T_target_source = T_start, .converged = true};
  const auto align_by = [&](const auto& associate) {
    return align(T_start, align_options,
                 [&](const Pose& T) { return associate(features, T, map_, options_.association); });
  };
  AlignResult result = options_.method == RegistrationMethod::gicp
                           ? align_by([](auto&&... args) { return associate_distributions(args...); })
                           : align_by([](auto&&... args) { return associate_points(args...); });
  result.candidates = features.patches.size();
  return result;
}

PointCloud ImprovedFloam::local_map() const {
  PointCloud map_in_world;
  map_in_world.points = map_.means();
  return map_in_world;
}

}  // namespace tilth
