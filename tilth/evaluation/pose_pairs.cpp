#include <algorithm>
#include <cmath>
#include <cstdio>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/pose_pairs.hpp>

namespace tilth {
namespace {

/// Added in the order of x, y, z: pairs that end exactly at delta must not depend on how a library orders the sum.
double step_length(const Trajectory& trajectory, std::size_t i) {
  const Eigen::Vector3d d = trajectory[i].T_world_lidar.translation() - trajectory[i - 1].T_world_lidar.translation();
  return std::sqrt(d.x() * d.x() + d.y() * d.y() + d.z() * d.z());
}

std::vector<double> path_of(const Trajectory& trajectory) {
  std::vector<double> path(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) path[i] = path[i - 1] + step_length(trajectory, i);
  return path;
}

std::vector<double> stamps_of(const Trajectory& trajectory) {
  std::vector<double> stamps;
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp);
  return stamps;
}

std::vector<PosePair> frame_pairs(std::size_t n, std::size_t delta, bool all_pairs) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i + delta < n; i += all_pairs ? 1 : delta) pairs.emplace_back(i, i + delta);
  return pairs;
}

std::vector<PosePair> consecutive_path_pairs(const Trajectory& trajectory, double delta) {
  std::vector<PosePair> pairs;
  std::size_t begin = 0;
  double path = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    path += step_length(trajectory, i);
    if (path < delta) continue;
    pairs.emplace_back(begin, i);
    begin = i;
    path = 0;
  }
  return pairs;
}

/// The first index after `i` whose value (ascending) differs from values[i] by most nearly delta. `i` must not be the
/// last.
std::size_t nearest_after(const std::vector<double>& values, std::size_t i, double delta) {
  const auto miss = [&](double value) { return std::abs(value - values[i] - delta); };
  const auto first = values.begin() + std::ptrdiff_t(i) + 1;
  auto nearest = std::lower_bound(first, values.end(), delta, [&](double v, double d) { return v - values[i] < d; });
  if (nearest == values.end() || (nearest != first && miss(*(nearest - 1)) <= miss(*nearest))) {
    nearest = std::lower_bound(first, nearest, miss(*(nearest - 1)), [&](double v, double m) { return miss(v) > m; });
  }
  return std::size_t(nearest - values.begin());
}

std::vector<PosePair> nearest_pairs(const std::vector<double>& values, const PairOptions& options) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i + 1 < values.size();) {
    const std::size_t j = nearest_after(values, i, options.delta);
    const bool found = std::abs(values[j] - values[i] - options.delta) <= options.tolerance * options.delta;
    if (found) pairs.emplace_back(i, j);
    i = found && !options.all_pairs ? j : i + 1;
  }
  return pairs;
}

std::vector<PosePair> pairs_of(const Trajectory& trajectory, const PairOptions& options) {
  switch (options.unit) {
    case DeltaUnit::frames: return frame_pairs(trajectory.size(), std::size_t(options.delta), options.all_pairs);
    case DeltaUnit::meters:
      if (!options.all_pairs) return consecutive_path_pairs(trajectory, options.delta);
      return nearest_pairs(path_of(trajectory), options);
    case DeltaUnit::seconds: return nearest_pairs(stamps_of(trajectory), options);
  }
  return {};
}

}  // namespace

std::vector<PosePair> pose_pairs(const Trajectory& trajectory, const PairOptions& options) {
  if (!(options.delta > 0)) throw Error("rpe_delta", "must be positive");
  if (options.unit == DeltaUnit::frames && options.delta != std::floor(options.delta)) {
    throw Error("rpe_delta", "must be a whole number where its unit is frames");
  }
  std::vector<PosePair> pairs = pairs_of(trajectory, options);
  if (!pairs.empty()) return pairs;
  char text[160];
  std::snprintf(text, sizeof text, "no two of the %zu matching poses are %g %s apart (a path of %.3f m, %.3f s)",
                trajectory.size(), options.delta, kDeltaUnitNames[std::size_t(options.unit)].data(),
                path_length(trajectory), trajectory.empty() ? 0.0 : trajectory.back().stamp - trajectory.front().stamp);
  throw Error("rpe_delta", text);
}

}  // namespace tilth
