#include <tilth/odometry/judged_odometry.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {

Slam::Slam(std::unique_ptr<Odometry> odometry, const SlamOptions& options)
    : odometry_(std::move(odometry)), keyframe_options_(options.loop.keyframe), thread_(options.loop) {
  odometry_->listen([this](std::string_view stage) { begin_stage(stage); });
}

OdometryResult Slam::register_scan(const Scan& scan) {
  OdometryResult result = odometry_->register_scan(scan);
  add_way(result);
  trajectory_.push_back({result.stamp, result.T_world_lidar});
  if (makes_keyframe(result)) add_keyframe(result, scan.stamp);
  return result;
}

void Slam::add_way(const OdometryResult& result) {
  if (!trajectory_.empty())
    path_ += (result.T_world_lidar.translation() - trajectory_.back().T_world_lidar.translation()).norm();
  covariance_ += result.alignment.covariance;
  if (begins_map(result)) {
    covariance_ += drift_after(result.stamp - known_until_);
    severed_ = true;
  }
  if (result.track.state != TrackState::lost || result.track.reason == TrackReason::new_map)
    known_until_ = result.stamp;
}

/// Far enough from the last one, or the first of a map; never a scan of which nothing was found.
bool Slam::makes_keyframe(const OdometryResult& result) const {
  if (keyframe_scans_.empty() || begins_map(result)) return true;
  if (result.track.reason == TrackReason::too_few_matches) return false;
  const Pose& T_odometry_keyframe = trajectory_[keyframe_scans_.back()].T_world_lidar;
  return is_keyframe(T_odometry_keyframe.inverse() * result.T_world_lidar, keyframe_options_);
}

void Slam::add_keyframe(const OdometryResult& result, double scan_stamp) {
  begin_stage("keyframe");
  Keyframe keyframe = make_keyframe(result, scan_stamp, keyframe_options_);
  keyframe.scan = trajectory_.size() - 1;
  keyframe.path = path_;
  keyframe.covariance = covariance_;
  keyframe.severed = severed_;
  covariance_.setZero();
  severed_ = false;
  keyframe_scans_.push_back(keyframe.scan);
  thread_.add(std::move(keyframe));
}

Trajectory Slam::moved_along(const std::vector<Pose>& T_map_keyframes) const {
  Trajectory corrected = trajectory_;
  const auto by_keyframe = [&](std::size_t k, std::size_t scan) -> Pose {
    const Pose& T_odometry_keyframe = trajectory_[keyframe_scans_[k]].T_world_lidar;
    return T_map_keyframes[k] * (T_odometry_keyframe.inverse() * trajectory_[scan].T_world_lidar);
  };
  for (std::size_t k = 0; k < T_map_keyframes.size(); ++k) {
    const bool last = k + 1 == T_map_keyframes.size();
    const std::size_t begin = keyframe_scans_[k], end = last ? corrected.size() : keyframe_scans_[k + 1];
    for (std::size_t i = begin; i < end; ++i) {
      const double ratio = double(i - begin) / double(end - begin);
      const Pose before = by_keyframe(k, i), after = last ? before : by_keyframe(k + 1, i);
      corrected[i].T_world_lidar = interpolate(before, after, ratio);
    }
  }
  return corrected;
}

Trajectory Slam::trajectory() const {
  return moved_along(loops().poses());
}

Trajectory Slam::trajectory_so_far() const {
  return moved_along(thread_.poses_so_far());
}

std::vector<std::pair<std::size_t, std::size_t>> Slam::joined_scans() const {
  const std::vector<Keyframe>& keyframes = loops().keyframes();
  const std::vector<bool> joined = loops().joined();
  std::vector<std::pair<std::size_t, std::size_t>> scans;
  bool open = false;
  for (std::size_t k = 1; k < keyframes.size(); ++k) {
    if (!keyframes[k].severed) continue;
    if (open) scans.back().second = keyframes[k].scan;
    open = joined[k];
    if (open) scans.emplace_back(keyframes[k].scan, trajectory_.size());
  }
  return scans;
}

}  // namespace tilth
