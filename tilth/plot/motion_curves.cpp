#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/plot/motion_curves.hpp>

namespace tilth {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian

/// One value a pose, over time.
template <class F>
Curve over_time(const Trajectory& trajectory, double start, const std::string& name, const F& value) {
  Curve curve{name, times_of(trajectory, start), {}, {}};
  for (const StampedPose& pose : trajectory) curve.y.push_back(float(value(pose.T_world_lidar)));
  return curve;
}

/// The same angles [deg], turns added so that no step is longer than half a turn.
void unwrap(std::vector<float>& angles) {
  for (std::size_t i = 1; i < angles.size(); ++i) {
    angles[i] += 360.0F * std::round((angles[i - 1] - angles[i]) / 360.0F);
  }
}

}  // namespace

std::vector<float> times_of(const Trajectory& trajectory, double start) {
  std::vector<float> times;
  for (const StampedPose& pose : trajectory) times.push_back(float(pose.stamp - start));
  return times;
}

AngleCurves angle_curves(const Trajectory& trajectory, double start, const std::string& name) {
  AngleCurves curves;
  curves.roll = over_time(trajectory, start, name,
                          [](const Pose& T) { return kDegrees * std::atan2(T.linear()(2, 1), T.linear()(2, 2)); });
  curves.pitch = over_time(trajectory, start, name, [](const Pose& T) {
    return kDegrees * std::asin(std::clamp(-T.linear()(2, 0), -1.0, 1.0));
  });
  curves.yaw = over_time(trajectory, start, name,
                         [](const Pose& T) { return kDegrees * std::atan2(T.linear()(1, 0), T.linear()(0, 0)); });
  unwrap(curves.yaw.y);
  return curves;
}

Curve speed_curve(const Trajectory& trajectory, double start, const std::string& name) {
  Curve curve{name, times_of(trajectory, start), {}, {}};
  const std::size_t n = trajectory.size();
  for (std::size_t i = 0; i < n; ++i) {
    const StampedPose& a = trajectory[i == 0 ? 0 : i - 1];
    const StampedPose& b = trajectory[std::min(i + 1, n - 1)];
    const double path = (b.T_world_lidar.translation() - a.T_world_lidar.translation()).norm();
    curve.y.push_back(b.stamp > a.stamp ? float(path / (b.stamp - a.stamp)) : 0.0F);
  }
  return curve;
}

Curve path_curve(const Trajectory& trajectory, const std::string& name) {
  Curve curve{name, {}, {}, {}};
  for (const StampedPose& pose : trajectory) {
    curve.x.push_back(float(pose.T_world_lidar.translation().x()));
    curve.y.push_back(float(pose.T_world_lidar.translation().y()));
  }
  return curve;
}

Curve height_curve(const Trajectory& trajectory, double start, const std::string& name) {
  return over_time(trajectory, start, name, [](const Pose& T) { return T.translation().z(); });
}

}  // namespace tilth
