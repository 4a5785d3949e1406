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
  const FeatureScan measured{joined(features.edges, features.planes), scan.stamp + middle, middle};
  const Registration found = find(measured);
  begin_stage("map");
  result.ambiguous = ambiguous_, result.relative = relative_,
  result.in_map = belongs_in_map(found.alignment, measured.stamp);
  result.poor = !result.in_map;
  if (result.in_map) {
    insert(std::move(patches), measured, found);
  } else {
    usual_.doubt();
  }

  result.stamp = measured.stamp;
  result.alignment = found.alignment;
  result.motion = found.motion;
  result.T_world_lidar = found.alignment.T_target_source;
  result.counts = {cloud.size(), cloud.size() - result.filtered.size(), features.edges.size(), features.planes.size()};
  return result;
}

bool ImprovedFloam::belongs_in_map(const AlignResult& alignment, double stamp) const {
  if (motion_.updates() == 0) return alignment.converged;
  return !ambiguous_ && !usual_.is_poor(alignment, stamp - motion_.last_time());
}

void ImprovedFloam::insert(SurfacePatches patches, const FeatureScan& scan, const Registration& registration) {
  const Pose& T_world_middle = registration.alignment.T_target_source;
  if (motion_.updates() == 0) {
    first_ = {patches, scan.middle, T_world_middle};
  } else {
    const double interval = scan.stamp - motion_.last_time();
    if (told_) trust_.judge(*told_, motion_.last_pose().inverse() * T_world_middle, interval, Matrix6d::Zero());
    usual_.add(registration.alignment, interval);
    first_.reset();
  }
  motion_.update(scan.stamp, T_world_middle);
  map_.insert(deskew(std::move(patches), registration.motion, scan.middle), T_world_middle);
  map_.crop(T_world_middle.translation());
}

ImprovedFloam::Registration ImprovedFloam::register_scan_from(const FeatureScan& scan, const Pose& T_start) const {
  // The second time the scan is straightened by the motion that the first time, which may be rough, has found.
  Registration registration{.alignment = {.T_target_source = T_start}};
  for (const AlignOptions& align : {rough(options_), options_.align}) {
    const Pose& T = registration.alignment.T_target_source;
    registration = register_once(scan, T, in_scan(motion_.velocity_to(scan.stamp, T), scan.middle), align);
  }
  return registration;
}

ImprovedFloam::Registration ImprovedFloam::register_once(const FeatureScan& scan, const Pose& T_start,
                                                         const MotionInScan& motion,
                                                         const AlignOptions& align_options) const {
  MatchedPatches<MapSurface> still{deskew(scan.features, motion, scan.middle)};
  return {register_features(still, T_start, align_options), motion};
}

AlignResult ImprovedFloam::register_features(MatchedPatches<MapSurface>& features, const Pose& T_start,
                                             const AlignOptions& align_options) const {
  if (motion_.updates() == 0) {
    AlignResult first = unmatched(T_start);
    first.converged = enough(features.patches.size());
    first.candidates = features.patches.size();
    if (first.converged) first.covariance.setZero();
    return first;
  }
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
