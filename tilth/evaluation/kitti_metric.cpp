#include <algorithm>
#include <array>
#include <cstdio>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/kitti_metric.hpp>
#include <tilth/evaluation/pose_error.hpp>

namespace tilth {
namespace {

constexpr std::array<double, 8> kLengths{100, 200, 300, 400, 500, 600, 700, 800};  // [m]
constexpr std::size_t kStep = 10;                                                  // [poses] between the first ones

std::vector<double> path_of(const Trajectory& trajectory) {
  std::vector<double> path(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    path[i] = path[i - 1] +
              (trajectory[i].T_world_lidar.translation() - trajectory[i - 1].T_world_lidar.translation()).norm();
  }
  return path;
}

SegmentError segment_error(const MatchedPoses& matches, std::size_t first, std::size_t last, double length) {
  const Pose truth = relative_pose(matches.truth[first].T_world_lidar, matches.truth[last].T_world_lidar);
  const Pose estimate = relative_pose(matches.estimate[first].T_world_lidar, matches.estimate[last].T_world_lidar);
  const Pose E = relative_pose(estimate, truth);
  return {length, E.translation().norm() / length, rotation_angle(E.linear()) / length};
}

/// The mean over the segments of `length`; over all of them where it is 0.
SegmentError mean_of(const std::vector<SegmentError>& segments, double length) {
  SegmentError mean{length, 0, 0};
  double n = 0;
  for (const SegmentError& segment : segments) {
    if (length > 0 && segment.length != length) continue;
    mean.translation += segment.translation;
    mean.rotation += segment.rotation;
    ++n;
  }
  mean.translation /= n;
  mean.rotation /= n;
  return mean;
}

std::vector<SegmentError> mean_by_length(const std::vector<SegmentError>& segments) {
  std::vector<SegmentError> means;
  for (const double length : kLengths) {
    const auto has_length = [&](const SegmentError& segment) { return segment.length == length; };
    if (std::any_of(segments.begin(), segments.end(), has_length)) means.push_back(mean_of(segments, length));
  }
  return means;
}

}  // namespace

KittiMetric kitti_metric(const MatchedPoses& matches) {
  const std::vector<double> path = path_of(matches.truth);
  KittiMetric metric;
  for (std::size_t first = 0; first < path.size(); first += kStep) {
    for (const double length : kLengths) {
      const auto last = std::upper_bound(path.begin() + std::ptrdiff_t(first), path.end(), path[first] + length);
      if (last == path.end()) break;
      metric.segments.push_back(segment_error(matches, first, std::size_t(last - path.begin()), length));
    }
  }
  if (metric.segments.empty()) {
    char text[120];
    std::snprintf(text, sizeof text, "the truth's path of %.1f m is shorter than KITTI's shortest segment of %g m",
                  path.empty() ? 0.0 : path.back(), kLengths.front());
    throw Error("kitti", text);
  }
  const SegmentError mean = mean_of(metric.segments, 0);
  metric.translation = mean.translation;
  metric.rotation = mean.rotation;
  metric.by_length = mean_by_length(metric.segments);
  return metric;
}

}  // namespace tilth
