#include <algorithm>
#include <cmath>

#include <tilth/core/median.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/beam_keyframe_sink.hpp>

namespace tilth {
namespace {

constexpr double kLongestGap = 0.45;  // [s] between poses that a parabola is laid through
constexpr double kBrightShare = 0.95;

Pose sensor_in_cloud(const Scan& scan) {
  return scan.T_cloud_sensor.value_or(Eigen::Isometry3d::Identity());
}

/// About the second of three poses, at constant acceleration through all of them.
MotionInScan motion_through(const std::vector<StampedPose>& poses, const MotionInScan& scan) {
  const double before = poses[0].stamp - poses[1].stamp, after = poses[2].stamp - poses[1].stamp;
  const Pose T_here_map = poses[1].T_world_lidar.inverse();
  const Vector6d from = log(T_here_map * poses[0].T_world_lidar) / before;
  const Vector6d to = log(T_here_map * poses[2].T_world_lidar) / after;
  MotionInScan motion;
  motion.acceleration = 2 * (to - from) / (after - before);
  motion.velocity = from - 0.5 * before * motion.acceleration;
  motion.begin = scan.begin, motion.duration = scan.duration;
  return motion;
}

/// The intensity that one return of twenty exceeds; nothing where there are none.
std::optional<double> brightness_of(const PointCloud& cloud) {
  std::vector<float> values;
  std::copy_if(cloud.intensities.begin(), cloud.intensities.end(), std::back_inserter(values),
               [](float v) { return std::isfinite(v); });
  if (values.empty()) return std::nullopt;
  const auto at = values.begin() + std::ptrdiff_t(kBrightShare * double(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

void BeamKeyframeSink::take(const Scan& scan, const OdometryResult& result, const RunRecord&) {
  count_rings(scan);
  if (result.track.state != TrackState::tracking) return leave_track(result.track.state);
  if (!past_.empty() && !(result.stamp - past_.back().stamp < kLongestGap)) past_.clear(), begun_.reset();
  if (past_.size() == 3) past_.erase(past_.begin());
  past_.push_back({result.stamp, result.T_world_lidar * sensor_in_cloud(scan)});
  if (begun_) complete_keyframe();
  if (past_.size() > 1 && result.filtered.has_rings() && far_enough(past_.back().T_world_lidar))
    begin_keyframe(scan, result);
}

void BeamKeyframeSink::finish(const RunRecord&) {
  gathered_.left_over = window_.size();
  const std::size_t before = windows_;
  close_window();
  if (windows_ > before) gathered_.left_over = 0;
  if (!brightness_.empty() && median(brightness_) > 0) gathered_.bright = median(brightness_);
}

void BeamKeyframeSink::count_rings(const Scan& scan) {
  const PointCloud& cloud = scan.cloud;
  if (cloud.has_rings()) {
    const std::size_t highest = *std::max_element(cloud.rings.begin(), cloud.rings.end());
    gathered_.rings = std::max(gathered_.rings, highest + 1);
  } else if (!cloud.empty()) {
    ++gathered_.scans_without_rings;
  }
}

void BeamKeyframeSink::leave_track(TrackState state) {
  past_.clear(), begun_.reset();
  if (state != TrackState::coasting) close_window();
}

void BeamKeyframeSink::complete_keyframe() {
  begun_->motion = motion_through(past_, begun_->motion);
  window_.push_back(std::move(*begun_));
  begun_.reset();
  if (window_.size() == std::size_t(options_.window)) close_window();
}

bool BeamKeyframeSink::far_enough(const Pose& T_map_sensor) const {
  return !last_place_ || (T_map_sensor.translation() - *last_place_).norm() >= options_.step;
}

void BeamKeyframeSink::begin_keyframe(const Scan& scan, const OdometryResult& result) {
  const Pose& T_map_sensor = past_.back().T_world_lidar;
  last_place_ = T_map_sensor.translation();
  BeamKeyframe keyframe{T_map_sensor, result.stamp - scan.stamp, result.motion, {}};
  keyframe.returns = scan.T_cloud_sensor
                         ? choose_returns(transform(result.filtered, scan.T_cloud_sensor->inverse()), {})
                         : choose_returns(result.filtered, {});
  begun_ = std::move(keyframe);
  if (const std::optional<double> bright = brightness_of(scan.cloud)) brightness_.push_back(*bright);
}

void BeamKeyframeSink::close_window() {
  if (window_.size() > std::size_t(options_.window) / 2) keep(std::move(window_));
  window_ = {};
}

void BeamKeyframeSink::keep(std::vector<BeamKeyframe> window) {
  KeyframeWindows& kept = gathered_.windows;
  if (windows_++ % every_ == 0) kept.push_back(std::move(window));
  if (kept.size() <= std::size_t(options_.most_windows)) return;
  for (std::size_t i = 1; 2 * i < kept.size(); ++i) kept[i] = std::move(kept[2 * i]);
  kept.resize((kept.size() + 1) / 2);
  every_ *= 2;
}

}  // namespace tilth
