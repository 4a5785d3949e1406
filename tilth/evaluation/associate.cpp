#include <algorithm>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/core/median.hpp>
#include <tilth/evaluation/associate.hpp>

namespace tilth {
namespace {

constexpr double kMedianIntervals = 3;  // that a gap may have where nothing else is asked for
constexpr double kShortGap = 0.2;       // [s] that a gap may have at least: vehicles do little in it
constexpr double kGapTolerance = 1e-6;  // of the limit: stamps are rounded

/// The pose of `trajectory`, whose stamps get `offset` added, nearest to `stamp`.
std::optional<std::size_t> nearest_pose(const Trajectory& trajectory, double offset, double stamp, double max_dt) {
  const auto stamp_of = [&](std::size_t i) { return trajectory[i].stamp + offset; };
  const std::size_t last = trajectory.size() - 1;
  if (stamp < stamp_of(0) - max_dt || stamp > stamp_of(last) + max_dt) return std::nullopt;
  const auto after = std::upper_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [&](double t, const StampedPose& pose) { return t < pose.stamp + offset; });
  const std::size_t upper = std::min(std::size_t(after - trajectory.begin()), last);
  const double above = stamp_of(upper) - stamp;
  const double below = upper > 0 ? stamp - stamp_of(upper - 1) : std::numeric_limits<double>::infinity();
  if (above <= max_dt && above < below) return upper;
  if (below <= max_dt && below <= above) return upper - 1;
  return std::nullopt;
}

/// Each pose of `few` with the nearest of `many`, whose stamps get `offset` added: {of few, of many}.
std::pair<Trajectory, Trajectory> match_nearest(const Trajectory& few, const Trajectory& many, double offset,
                                                double max_dt) {
  std::pair<Trajectory, Trajectory> matches;
  for (const StampedPose& pose : few) {
    const auto nearest = nearest_pose(many, offset, pose.stamp, max_dt);
    if (!nearest) continue;
    matches.first.push_back(pose);
    matches.second.push_back(many[*nearest]);
  }
  return matches;
}

/// Position on the straight line, rotation on the shortest way.
Pose between(const StampedPose& a, const StampedPose& b, double stamp) {
  if (b.stamp <= a.stamp) return a.T_world_lidar;
  const double s = (stamp - a.stamp) / (b.stamp - a.stamp);
  const Eigen::Quaterniond from(a.T_world_lidar.linear()), to(b.T_world_lidar.linear());
  Pose T = Pose::Identity();
  T.linear() = from.normalized().slerp(s, to.normalized()).toRotationMatrix();
  T.translation() = a.T_world_lidar.translation() + s * (b.T_world_lidar.translation() - a.T_world_lidar.translation());
  return T;
}

void leave_out(double from, double to, std::vector<TruthGap>& gaps) {
  if (gaps.empty() || gaps.back().from != from) gaps.push_back({from, to, 0});
  ++gaps.back().left_out;
}

MatchedPoses match_interpolated(const Trajectory& truth, const Trajectory& estimate,
                                const StampAssociationOptions& options) {
  const double limit = gap_limit(truth, options) * (1 + kGapTolerance);
  MatchedPoses matches;
  for (const StampedPose& pose : estimate) {
    const double stamp = pose.stamp + options.time_offset;
    if (stamp < truth.front().stamp || stamp > truth.back().stamp) continue;
    const auto before_stamp = [](const StampedPose& p, double t) { return p.stamp < t; };
    const auto after = std::lower_bound(truth.begin(), truth.end() - 1, stamp, before_stamp);
    const auto before = after == truth.begin() ? after : after - 1;
    if (after->stamp != stamp && after->stamp - before->stamp > limit) {
      leave_out(before->stamp, after->stamp, matches.gaps);
      continue;
    }
    matches.truth.push_back({stamp, between(*before, *after, stamp)});
    matches.estimate.push_back(pose);
  }
  return matches;
}

std::string range_of(const char* name, const Trajectory& trajectory) {
  char text[160];
  std::snprintf(text, sizeof text, "the %s has %zu poses from %.6f s to %.6f s", name, trajectory.size(),
                trajectory.front().stamp, trajectory.back().stamp);
  return text;
}

[[noreturn]] void refuse_no_match(const Trajectory& truth, const Trajectory& estimate,
                                  const StampAssociationOptions& options) {
  char bound[120];
  std::snprintf(bound, sizeof bound,
                options.interpolate ? "no stamp of the estimate lies within the truth and outside its gaps"
                                    : "no stamps match within max_dt = %g s",
                options.max_dt);
  char offset[80];
  std::snprintf(offset, sizeof offset, " (time_offset = %g s added to the estimate's)", options.time_offset);
  throw Error("association",
              bound + std::string(offset) + ": " + range_of("truth", truth) + ", " + range_of("estimate", estimate));
}

}  // namespace

double gap_limit(const Trajectory& truth, const StampAssociationOptions& options) {
  if (options.max_gap > 0) return options.max_gap;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < truth.size(); ++i) intervals.push_back(truth[i].stamp - truth[i - 1].stamp);
  if (intervals.empty()) return kShortGap;
  return std::max(kShortGap, kMedianIntervals * median(std::move(intervals)));
}

MatchedPoses associate(const Trajectory& truth, const Trajectory& estimate, const StampAssociationOptions& options) {
  if (truth.empty()) throw Error("truth", "has no pose");
  if (estimate.empty()) throw Error("estimate", "has no pose");
  MatchedPoses matches;
  if (options.interpolate) {
    matches = match_interpolated(truth, estimate, options);
  } else if (estimate.size() > truth.size()) {
    std::tie(matches.truth, matches.estimate) = match_nearest(truth, estimate, options.time_offset, options.max_dt);
  } else {
    std::tie(matches.estimate, matches.truth) = match_nearest(estimate, truth, -options.time_offset, options.max_dt);
  }
  if (matches.truth.empty()) refuse_no_match(truth, estimate, options);
  return matches;
}

MatchedPoses associate_by_index(const Trajectory& truth, const Trajectory& estimate) {
  if (truth.size() != estimate.size()) {
    throw Error("association", "without stamps in both files poses match by their number, but the truth has " +
                                   std::to_string(truth.size()) + " poses and the estimate " +
                                   std::to_string(estimate.size()));
  }
  return {truth, estimate};
}

}  // namespace tilth
