#include <algorithm>
#include <cmath>
#include <cstdio>

#include <tilth/io/cloud_records.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/run_messages.hpp>

namespace tilth {
namespace {

/// Evenly, in the order of the points.
std::vector<std::uint32_t> thinned_indices(std::size_t count, std::uint64_t most) {
  std::vector<std::uint32_t> indices(std::min<std::uint64_t>(count, most));
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = std::uint32_t(i * count / indices.size());
  return indices;
}

/// The cloud as seen from the pose of `result`; its times go, since all points now share the pose's.
PointCloud seen_at_once(PointCloud cloud, const Scan& scan, const OdometryResult& result) {
  if (cloud.has_times()) {
    const ScanMotion motion(result.motion, result.stamp - scan.stamp);  // on the clock of the points' times
    for (std::size_t i = 0; i < cloud.size(); ++i) cloud.points[i] = motion.move(cloud.points[i], cloud.times[i]);
  }
  cloud.times.clear();
  return cloud;
}

DiagnosticLevel level_of(TrackState state) {
  switch (state) {
    case TrackState::tracking: return DiagnosticLevel::ok;
    case TrackState::coasting:
    case TrackState::recovered: return DiagnosticLevel::warn;
    case TrackState::lost: break;
  }
  return DiagnosticLevel::error;
}

DiagnosticLevel level_of(MapState state) {
  switch (state) {
    case MapState::located: return DiagnosticLevel::ok;
    case MapState::lost: return DiagnosticLevel::error;
    default: return DiagnosticLevel::warn;
  }
}

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

}  // namespace

std::vector<NamedTopic> run_topics() {
  return {{"/path", path_type()},         {"/map", point_cloud2_type()},  {"/tf", tf_type()},
          {"/odometry", odometry_type()}, {"/scan", point_cloud2_type()}, {"/diagnostics", diagnostics_type()}};
}

RunFrames frames_of(const RunRecord& record) {
  return {record.T_base_lidar, record.T_map_odom};
}

Frames names_in(const RunFrames& frames) {
  return {frames.T_map_odom ? "odom" : Frames{}.world, body_of(frames.T_base_lidar)};
}

std::uint64_t nanoseconds(double stamp) {
  return stamp > 0.0 ? std::uint64_t(std::llround(stamp * 1e9)) : 0;
}

std::vector<std::byte> scan_message(const Scan& scan, const OdometryResult& result, std::uint64_t points,
                                    const std::string& frame, Serialization serialization) {
  const PointCloud& cloud = result.filtered;
  const PointCloud seen = seen_at_once(select(cloud, thinned_indices(cloud.size(), points)), scan, result);
  return serialize_point_cloud2({result.stamp, frame, to_records(seen)}, serialization);
}

std::vector<std::byte> tf_message(const StampedPose& pose, const RunFrames& frames) {
  const Frames names = names_in(frames);
  std::vector<StampedTransform> transforms;
  if (frames.T_map_odom) transforms.push_back({pose.stamp, {Frames{}.world, names.world}, *frames.T_map_odom});
  transforms.push_back({pose.stamp, names, pose_of_base(pose.T_world_lidar, frames.T_base_lidar)});
  if (frames.T_base_lidar) transforms.push_back({pose.stamp, {names.body, body_of({})}, *frames.T_base_lidar});
  return serialize_tf(transforms);
}

std::vector<std::byte> odometry_message(const StampedPose& pose, const Matrix6d& covariance, const RunFrames& frames) {
  return serialize_odometry({pose.stamp, pose_of_base(pose.T_world_lidar, frames.T_base_lidar)},
                            covariance_of_base(covariance, frames.T_base_lidar), names_in(frames));
}

std::vector<std::byte> path_message(const Trajectory& poses, const RunFrames& frames) {
  return serialize_path(poses_of_base(poses, frames.T_base_lidar), names_in(frames));
}

std::vector<std::byte> map_message(double stamp, PointRecords map, const std::string& frame,
                                   Serialization serialization) {
  return serialize_point_cloud2({stamp, frame, std::move(map)}, serialization);
}

Diagnostic track_diagnostic(const ScanRow& row) {
  const std::string state(names_of(row.track.state)[std::size_t(row.track.state)]);
  const std::string reason(names_of(row.track.reason)[std::size_t(row.track.reason)]);
  Diagnostic diagnostic{row.stamp, level_of(row.track.state), "tilth: track", state, {}};
  if (!reason.empty()) diagnostic.message += ": " + reason;
  diagnostic.values = {{"track", state},
                       {"register_ms", figure(row.register_ms)},
                       {"read_ms", figure(row.read_ms)},
                       {"build_map_ms", figure(row.map_ms)},
                       {"points", std::to_string(row.points_in)},
                       {"matches", std::to_string(row.matches)},
                       {"candidates", std::to_string(row.candidates)},
                       {"degenerate_directions", std::to_string(row.degenerate_directions)}};
  return diagnostic;
}

std::vector<std::byte> diagnostics_message(const ScanRow& row) {
  return serialize_diagnostic(track_diagnostic(row));
}

Trajectory thinned(const Trajectory& poses, std::size_t most) {
  const std::size_t every = std::max<std::size_t>(1, poses.size() / most);
  Trajectory some;
  for (std::size_t i = 0; i < poses.size(); i += every) some.push_back(poses[i]);
  if (!poses.empty() && some.back().stamp != poses.back().stamp) some.push_back(poses.back());
  return some;
}

Diagnostic place_diagnostic(const LocalizationRow& row) {
  const std::string state(names_of(row.state)[std::size_t(row.state)]);
  Diagnostic diagnostic{row.stamp, level_of(row.state), "tilth: place in the map", state, {}};
  diagnostic.values = {{"place", state},
                       {"register_ms", figure(row.milliseconds)},
                       {"overlap", figure(row.overlap)},
                       {"through", figure(row.through)},
                       {"hypotheses", std::to_string(row.hypotheses.size())}};
  return diagnostic;
}

std::vector<std::byte> diagnostics_message(const LocalizationRow& row) {
  return serialize_diagnostic(place_diagnostic(row));
}

}  // namespace tilth
