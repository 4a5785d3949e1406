#include <algorithm>

#include <tilth/odometry/tilth_odometry.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
namespace {

/// At most `most` of the patches, evenly along the rings.
SurfacePatches evenly(const SurfacePatches& patches, std::size_t most) {
  if (patches.size() <= most) return patches;
  SurfacePatches chosen;
  chosen.reserve(most);
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(patches[i * patches.size() / most]);
  return chosen;
}

/// The pose `time` [s] after the middle of a scan of which the alignment tells.
Pose pose_in_scan(const ContinuousTimeAlignment& alignment, double time) {
  return alignment.pose.T_target_source * alignment.motion.at(time);
}

}  // namespace

OdometryResult TilthOdometry::register_scan(const Scan& scan) {
  OdometryResult result;
  begin_stage("crop");
  const PointCloud cloud = crop_range(scan.cloud, options_.min_range, options_.max_range);
  begin_stage("outliers");
  arrange(cloud, rings_);
  const std::vector<std::uint8_t> keep =
      ring_support(rings_, cloud.size(), options_.outliers).value_or(std::vector<std::uint8_t>(cloud.size(), 1));
  result.filtered = select_kept(cloud, keep);
  begin_stage("features");
  const SurfacePatches patches = surface_patches(cloud, rings_, keep, options_.patches);

  begin_stage("registration");
  const double scan_duration = duration(cloud), middle = 0.5 * scan_duration;
  motion_.interval = registered_ > 0 ? scan.stamp + middle - last_middle_ : 0.0;
  const ContinuousTimeAlignment alignment = register_patches(patches, middle);
  begin_stage("map");
  if (registered_ == 0) begin_ = scan.stamp + middle;
  result.covariance = covariance_of(alignment, scan.stamp + middle - begin_);
  last_middle_ = scan.stamp + middle;
  insert(patches, middle, alignment);
  if (first_ && registered_ >= 2 && last_middle_ - begin_ >= options_.reanchor_after) reanchor();

  result.alignment = alignment.pose;
  result.alignment.T_target_source = T_world_map_ * alignment.pose.T_target_source;
  const double pose_time = (options_.pose_at - 0.5) * scan_duration;
  result.motion = alignment.motion.from(pose_time);
  result.stamp = scan.stamp + options_.pose_at * scan_duration;
  result.T_world_lidar = T_world_map_ * pose_in_scan(alignment, pose_time);
  const auto flat = std::count_if(patches.begin(), patches.end(), [](const SurfacePatch& p) { return p.flat; });
  result.counts = {cloud.size(), cloud.size() - result.filtered.size(), patches.size() - std::size_t(flat),
                   std::size_t(flat)};
  return result;
}

ContinuousTimeAlignment TilthOdometry::align_to_map(const SurfacePatches& patches, double middle,
                                                    const MotionPrior& prior) const {
  return align_continuous_time(evenly(patches, std::size_t(options_.max_patches)), middle, prior, map_,
                               options_.align);
}

ContinuousTimeAlignment TilthOdometry::register_patches(const SurfacePatches& patches, double middle) {
  const bool enough = patches.size() >= std::size_t(options_.align.min_matches);
  if (registered_ == 0 && enough) return {.pose = {.converged = true, .candidates = patches.size()}};
  if (registered_ != 1) return align_to_map(patches, middle, motion_);
  // The second scan tells how the sensor moved in the first one, which then is straightened anew.
  constexpr int kRounds = 4;
  ContinuousTimeAlignment alignment;
  for (int round = 0; round < kRounds; ++round) {
    alignment = align_to_map(patches, middle, motion_);
    motion_.velocity = alignment.motion.velocity;
    map_ = PatchMap(options_.map);
    const MotionInScan motion = MotionInScan::steady(alignment.motion.velocity, first_->middle);
    map_.insert(deskew(first_->patches, motion, first_->middle), motion_.T_map_last);
  }
  return alignment;
}

Matrix6d TilthOdometry::covariance_of(const ContinuousTimeAlignment& alignment, double time) {
  const Pose& T_map_lidar = alignment.pose.T_target_source;
  const Matrix6d since_first =
      uncertainty_.add({.time = time,
                        .T_map_lidar = T_map_lidar,
                        .covariance = options_.covariance_scale * alignment.covariance,
                        .surfaces_seen_at = alignment.surfaces_seen_at.value_or(last_middle_ - begin_),
                        .dead_reckoned = alignment.dead_reckoned});
  if (is_first(alignment)) return since_first;
  // Hardly anything tells of the vibration of the first scan, whose pose all others are seen from.
  const Vector6d first = observed_sigma(motion_.vibration, options_.align.vibration).variances();
  const Matrix6d to_lidar = adjoint(T_map_lidar.inverse());
  return since_first + to_lidar * first.asDiagonal() * to_lidar.transpose();
}

void TilthOdometry::insert(const SurfacePatches& patches, double middle, const ContinuousTimeAlignment& alignment) {
  const bool first = is_first(alignment);
  if (first) first_ = {patches, middle};
  motion_ = next(motion_, alignment);
  if (!first && alignment.pose.matches < std::size_t(options_.align.min_matches)) return;
  const Pose& T_map_middle = alignment.pose.T_target_source;
  MotionInScan motion = alignment.motion;
  motion.vibration = without(motion.vibration, motion_.vibration_mean);
  map_.insert(deskew(patches, motion, middle), T_map_middle, last_middle_ - begin_);
  map_.crop(T_map_middle.translation());
  if (++registered_ != 2) return;
  first_->motion = motion_;
  first_->motion.interval = begin_ - last_middle_;
}

void TilthOdometry::reanchor() {
  first_->motion.vibration = motion_.vibration;
  const ContinuousTimeAlignment first = align_to_map(first_->patches, first_->middle, first_->motion);
  if (first.pose.converged) T_world_map_ = pose_in_scan(first, (2 * options_.pose_at - 1) * first_->middle).inverse();
  first_.reset();
}

PointCloud TilthOdometry::local_map() const {
  PointCloud map;
  map.points = map_.means();
  return transform(map, T_world_map_);
}

}  // namespace tilth
