#include <algorithm>

#include <tilth/odometry/tilth_odometry.hpp>
#include <tilth/preprocess/cell_support.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {
OdometryResult TilthOdometry::register_scan(const Scan& scan) {
  begin_stage("crop");
  const PointCloud cloud = crop_range(scan.cloud, options_.min_range, options_.max_range);
  begin_stage("outliers");
  arrange(cloud, rings_);
  const std::vector<std::uint8_t> keep = supported(cloud, rings_, options_.outliers);
  PointCloud filtered = select_kept(cloud, keep);
  begin_stage("features");
  const ScanPatches patches{scan.stamp, duration(cloud), surface_patches(cloud, rings_, keep, options_.patches)};

  begin_stage("registration");
  const std::optional<Pose> told = told_motion(patches.time());
  const MotionPrior prior = expected(patches.time(), told);
  const ContinuousTimeAlignment alignment = align(patches, prior);
  begin_stage("map");
  const Matrix6d covariance = covariance_of(alignment, patches.time());
  const bool in_map = belongs_in_map(alignment, prior.interval);
  if (told && in_map)
    trust_.judge(*told, prior.T_map_last.inverse() * alignment.pose.T_target_source, prior.interval,
                 alignment.dead_reckoned);
  if (in_map) {
    insert(patches, alignment);
  } else {
    usual_.doubt();
  }
  if (world_.is_due(patches.time())) reanchor();

  OdometryResult result = result_of(alignment, patches);
  result.covariance = covariance;
  result.ambiguous = ambiguous_, result.poor = !in_map, result.in_map = in_map, result.relative = relative_;
  result.counts.points_in = cloud.size();
  result.counts.outliers = cloud.size() - filtered.size();
  result.filtered = std::move(filtered);
  return result;
}

std::optional<Pose> TilthOdometry::told_motion(double time) const {
  if (!external_ || world_.empty()) return std::nullopt;
  return external_->between(motion_.last_time(), time);
}

MotionPrior TilthOdometry::expected(double time, const std::optional<Pose>& told) const {
  MotionPrior prior = motion_.predict(time);
  if (!told || !prior.known) return prior;
  prior.claim = trust_.claim(*told, prior.interval, prior.velocity);
  if (prior.claim) prior.velocity = joined_velocity(prior.velocity, *prior.claim, prior.interval);
  return prior;
}

Matrix6d TilthOdometry::covariance_of(const ContinuousTimeAlignment& alignment, double time) {
  const Pose& T_map_lidar = alignment.pose.T_target_source;
  const Matrix6d since_first =
      uncertainty_.add({.time = world_.age(time),
                        .T_map_lidar = T_map_lidar,
                        .covariance = options_.covariance_scale * alignment.covariance,
                        .surfaces_seen_at = alignment.surfaces_seen_at.value_or(world_.age(motion_.last_time())),
                        .dead_reckoned = alignment.dead_reckoned});
  if (world_.empty() && alignment.pose.converged) return since_first;
  // Hardly anything tells of the vibration of the first scan, whose pose all others are seen from.
  const Vector6d first = motion_.vibration().observed().variances();
  const Matrix6d to_lidar = adjoint(T_map_lidar.inverse());
  return since_first + to_lidar * first.asDiagonal() * to_lidar.transpose();
}

bool TilthOdometry::belongs_in_map(const ContinuousTimeAlignment& alignment, double interval) const {
  if (world_.empty()) return alignment.pose.converged;
  return enough(alignment.pose.matches) && !ambiguous_ && !usual_.is_poor(alignment.pose, interval);
}

void TilthOdometry::insert(const ScanPatches& scan, const ContinuousTimeAlignment& alignment) {
  const bool first = world_.empty();
  if (first) world_.begin(scan);
  if (!first) usual_.add(alignment.pose, scan.time() - motion_.last_time());
  motion_.update(scan.time(), alignment);
  MotionInScan motion = alignment.motion;
  motion.vibration = motion_.vibration().without_mean(motion.vibration);
  const Pose& T_map_middle = alignment.pose.T_target_source;
  map_.insert(deskew(scan.patches, motion, scan.middle()), T_map_middle, world_.age(scan.time()));
  map_.crop(T_map_middle.translation());
  if (!first && world_.awaits_second()) world_.add_second(motion_.predict(world_.first_time()));
}

void TilthOdometry::reanchor() {
  const ScanPatches& first = world_.first_scan();
  const ContinuousTimeAlignment alignment = align_to_map(first, world_.prior_of_first(motion_.vibration().sigma()));
  world_.anchor(motion_.last_time(),
                alignment.pose.converged ? std::optional(pose_in_scan(alignment, first)) : std::nullopt);
}

Pose TilthOdometry::pose_in_scan(const ContinuousTimeAlignment& alignment, const ScanPatches& scan) const {
  return alignment.pose.T_target_source * alignment.motion.at(lever_of_pose(scan));
}

OdometryResult TilthOdometry::result_of(const ContinuousTimeAlignment& alignment, const ScanPatches& scan) const {
  OdometryResult result;
  result.alignment = alignment.pose;
  result.alignment.T_target_source = world_.T_world_map() * alignment.pose.T_target_source;
  result.motion = alignment.motion.from(lever_of_pose(scan));
  result.stamp = scan.stamp + options_.pose_at * scan.duration;
  result.T_world_lidar = world_.T_world_map() * pose_in_scan(alignment, scan);
  const auto flat =
      std::count_if(scan.patches.begin(), scan.patches.end(), [](const SurfacePatch& p) { return p.flat; });
  result.counts.planes = std::size_t(flat);
  result.counts.edges = scan.patches.size() - std::size_t(flat);
  return result;
}

PointCloud TilthOdometry::local_map() const {
  PointCloud map;
  map.points = map_.means();
  return transform(map, world_.T_world_map());
}

}  // namespace tilth
