#include <algorithm>
#include <cmath>
#include <utility>

#include <tilth/core/beam_model.hpp>
#include <tilth/core/median.hpp>
#include <tilth/odometry/beam_keyframe_gatherer.hpp>

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

std::optional<BeamKeyframeGatherer::Window> BeamKeyframeGatherer::take(const Scan& scan, const PointCloud& cloud,
                                                                       const OdometryResult& result) {
  count_rings(scan.cloud);
  if (result.track.state != TrackState::tracking) return leave_track(result.track.state);
  if (!past_.empty() && !(result.stamp - past_.back().stamp < kLongestGap)) past_.clear(), begun_.reset();
  if (past_.size() == 3) past_.erase(past_.begin());
  past_.push_back({result.stamp, result.T_world_lidar * sensor_in_cloud(scan)});
  std::optional<Window> window;
  if (begun_) window = complete_keyframe();
  if (past_.size() > 1 && cloud.has_rings() && far_enough(past_.back().T_world_lidar))
    begin_keyframe(scan, cloud, result);
  return window;
}

std::optional<BeamKeyframeGatherer::Window> BeamKeyframeGatherer::finish() {
  return close_window();
}

double BeamKeyframeGatherer::bright() const {
  const double middle = brightness_.empty() ? 0 : median(brightness_);
  return middle > 0 ? middle : BeamModel{}.bright;
}

void BeamKeyframeGatherer::count_rings(const PointCloud& cloud) {
  if (cloud.has_rings()) {
    const std::size_t highest = *std::max_element(cloud.rings.begin(), cloud.rings.end());
    rings_ = std::max(rings_, highest + 1);
  } else if (!cloud.empty()) {
    ++scans_without_rings_;
  }
}

std::optional<BeamKeyframeGatherer::Window> BeamKeyframeGatherer::leave_track(TrackState state) {
  past_.clear(), begun_.reset();
  if (state == TrackState::coasting) return std::nullopt;
  std::optional<Window> window = close_window();
  window_.clear();
  return window;
}

std::optional<BeamKeyframeGatherer::Window> BeamKeyframeGatherer::complete_keyframe() {
  begun_->motion = motion_through(past_, begun_->motion);
  window_.push_back(std::move(*begun_));
  begun_.reset();
  return window_.size() == std::size_t(options_.window) ? close_window() : std::nullopt;
}

bool BeamKeyframeGatherer::far_enough(const Pose& T_map_sensor) const {
  return !last_place_ || (T_map_sensor.translation() - *last_place_).norm() >= options_.step;
}

void BeamKeyframeGatherer::begin_keyframe(const Scan& scan, const PointCloud& cloud, const OdometryResult& result) {
  const Pose& T_map_sensor = past_.back().T_world_lidar;
  last_place_ = T_map_sensor.translation();
  BeamKeyframe keyframe{T_map_sensor, result.stamp - scan.stamp, result.motion, {}};
  const ReturnChoice choice{.most = std::size_t(options_.returns)};
  keyframe.returns = scan.T_cloud_sensor ? choose_returns(transform(cloud, scan.T_cloud_sensor->inverse()), choice)
                                         : choose_returns(cloud, choice);
  begun_ = std::move(keyframe);
  if (const std::optional<double> bright = brightness_of(scan.cloud)) brightness_.push_back(*bright);
}

std::optional<BeamKeyframeGatherer::Window> BeamKeyframeGatherer::close_window() {
  if (window_.size() <= std::size_t(options_.window) / 2) return std::nullopt;
  return std::exchange(window_, {});
}

}  // namespace tilth
