#include <algorithm>
#include <numbers>

#include <tilth/odometry/motion_search.hpp>
#include <tilth/odometry/usual_fit.hpp>

namespace tilth {
namespace {

constexpr double kMostRadius = 12.0;  // [m]

}  // namespace

SearchWindow window_after(double interval, double speed) {
  constexpr double kSlack = 0.5, kAcceleration = 3.0;  // [m] [m/s^2]
  constexpr double kYawSlack = 0.1, kTurn = 2.5;       // [rad] [rad/s]
  const double radius = kSlack + 0.5 * kAcceleration * interval * interval + 0.5 * speed * interval;
  return {std::min(radius, kMostRadius), std::min(kYawSlack + kTurn * interval, std::numbers::pi)};
}

SearchWindow window_at_start(double interval) {
  constexpr double kSpeed = 35.0, kTurn = 2.5;  // [m/s] [rad/s]
  constexpr double kYawSlack = 0.1;             // [rad]
  return {std::min(kSpeed * interval, kMostRadius), std::min(kYawSlack + kTurn * interval, std::numbers::pi)};
}

std::vector<FacingPoint> facing_points(const SurfacePatches& patches) {
  std::vector<FacingPoint> points;
  for (const SurfacePatch& patch : patches) points.push_back({patch.mean, patch.normal});
  return points;
}

std::vector<FacingPoint> facing_points(const PatchMap& map) {
  std::vector<FacingPoint> points;
  for (const MapSurface& surface : map.surfaces()) points.push_back({surface.mean, surface.normal});
  return points;
}

std::vector<Pose> poses_to_try(const PatchMap& map, const SurfacePatches& seen, const Pose& T_map_expected,
                               const Pose& T_map_last, const SearchWindow& window) {
  std::vector<Pose> poses{T_map_expected, T_map_last};
  for (const PoseCandidate& candidate :
       search_poses(facing_points(map), facing_points(seen), T_map_expected, window, {}))
    poses.push_back(candidate.T_target_source);
  return poses;
}

Choice choose(std::span<const AlignResult> registrations) {
  constexpr double kSamePlace = 0.3, kSameHeading = 0.05;  // [m] [rad]
  constexpr double kAlike = 0.93;                          // of the best fit
  const auto less = [](const AlignResult& a, const AlignResult& b) { return fit_of(a) < fit_of(b); };
  const auto best = std::max_element(registrations.begin(), registrations.end(), less);
  const auto is_rival = [&](const AlignResult& other) {
    const Pose apart = best->T_target_source.inverse() * other.T_target_source;
    const bool same = apart.translation().norm() < kSamePlace && angle_of(apart) < kSameHeading;
    return !same && fit_of(other) > kAlike * fit_of(*best);
  };
  return {std::size_t(best - registrations.begin()), std::any_of(registrations.begin(), registrations.end(), is_rival)};
}

}  // namespace tilth
