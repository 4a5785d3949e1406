#include <algorithm>

#include <tilth/slam/slam.hpp>

namespace tilth {

Slam::Slam(std::unique_ptr<Odometry> odometry, const SlamOptions& options)
    : odometry_(std::move(odometry)), keyframe_options_(options.loop.keyframe), closer_(options.loop) {
  odometry_->listen([this](std::string_view stage) { begin_stage(stage); });
}

OdometryResult Slam::register_scan(const Scan& scan) {
  OdometryResult result = odometry_->register_scan(scan);
  if (!trajectory_.empty())
    path_ += (result.T_world_lidar.translation() - trajectory_.back().T_world_lidar.translation()).norm();
  trajectory_.push_back({result.stamp, result.T_world_lidar});
  covariance_ += result.alignment.covariance;
  const std::vector<Keyframe>& keyframes = closer_.keyframes();
  if (keyframes.empty() ||
      is_keyframe(keyframes.back().T_odometry_lidar.inverse() * result.T_world_lidar, keyframe_options_))
    add_keyframe(result, scan.stamp);
  return result;
}

void Slam::add_keyframe(const OdometryResult& result, double scan_stamp) {
  begin_stage("keyframe");
  Keyframe keyframe = make_keyframe(result, scan_stamp, keyframe_options_);
  keyframe.scan = trajectory_.size() - 1;
  keyframe.path = path_;
  keyframe.covariance = covariance_;
  covariance_.setZero();
  closer_.add(std::move(keyframe), [this](std::string_view stage) { begin_stage(stage); });
}

Trajectory Slam::trajectory() const {
  const std::vector<Keyframe>& keyframes = closer_.keyframes();
  Trajectory corrected = trajectory_;
  const auto by_keyframe = [&](std::size_t k, std::size_t scan) -> Pose {
    return closer_.poses()[k] * (keyframes[k].T_odometry_lidar.inverse() * trajectory_[scan].T_world_lidar);
  };
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const bool last = k + 1 == keyframes.size();
    const std::size_t begin = keyframes[k].scan, end = last ? corrected.size() : keyframes[k + 1].scan;
    for (std::size_t i = begin; i < end; ++i) {
      const double ratio = double(i - begin) / double(end - begin);
      const Pose before = by_keyframe(k, i), after = last ? before : by_keyframe(k + 1, i);
      corrected[i].T_world_lidar = interpolate(before, after, ratio);
    }
  }
  return corrected;
}

}  // namespace tilth
