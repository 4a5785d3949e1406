#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/cloud_records.hpp>
#include <tilth/io/mcap_writer.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/messages/pose_message.hpp>
#include <tilth/messages/ros2_definitions.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/mcap_sink.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {
namespace {

std::uint32_t add_topic(McapWriter& file, const std::string& topic, const Ros2Type& type) {
  Connection connection;
  connection.topic = topic, connection.type = type.name, connection.definition = type.definition;
  return file.add_connection(connection);
}

std::uint64_t nanoseconds(double stamp) {
  return stamp > 0.0 ? std::uint64_t(std::llround(stamp * 1e9)) : 0;
}

/// Evenly, in the order of the points.
std::vector<std::uint32_t> thinned(std::size_t count, std::uint64_t most) {
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

}  // namespace

McapSink::McapSink(const std::filesystem::path& path, std::uint64_t points)
    : file_(std::make_unique<McapWriter>(path)),
      points_(points),
      path_topic_(add_topic(*file_, "/path", path_type())),
      map_topic_(add_topic(*file_, "/map", point_cloud2_type())),
      tf_topic_(add_topic(*file_, "/tf", tf_type())),
      odometry_topic_(add_topic(*file_, "/odometry", odometry_type())),
      scan_topic_(add_topic(*file_, "/scan", point_cloud2_type())) {}

McapSink::~McapSink() = default;

void McapSink::take(const Scan& scan, const OdometryResult& result, const RunRecord&) {
  if (points_ == 0 || result.filtered.empty() || !problem_.empty()) return;
  try {
    write_scan(scan, result);
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
}

void McapSink::write_scan(const Scan& scan, const OdometryResult& result) {
  const PointCloud& cloud = result.filtered;
  const PointCloud seen = seen_at_once(select(cloud, thinned(cloud.size(), points_)), scan, result);
  const PointCloud2 message{result.stamp, Frames{}.lidar, to_records(seen)};
  file_->write(scan_topic_, nanoseconds(result.stamp), serialize_point_cloud2(message, Serialization::cdr));
}

void McapSink::finish(const RunRecord& record) {
  if (!problem_.empty()) throw Error("run.mcap", problem_);
  const Trajectory& trajectory = record.trajectory;
  const Frames frames;
  const double begin = trajectory.empty() ? 0.0 : trajectory.front().stamp;
  file_->write(path_topic_, nanoseconds(begin), serialize_path(trajectory, frames));
  file_->write(map_topic_, nanoseconds(begin),
               serialize_point_cloud2({begin, frames.world, record.map.records()}, Serialization::cdr));
  const std::size_t without_row = trajectory.size() - std::min(trajectory.size(), record.scans.rows.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Vector6d variances = i < without_row ? Vector6d::Zero() : record.scans.rows[i - without_row].variances;
    const std::uint64_t stamp = nanoseconds(trajectory[i].stamp);
    file_->write(tf_topic_, stamp, serialize_tf(trajectory[i], frames));
    file_->write(odometry_topic_, stamp, serialize_odometry(trajectory[i], variances, frames));
  }
  file_->close();
}

}  // namespace tilth
