#include <cmath>
#include <cstdint>

#include <tilth/io/mcap_writer.hpp>
#include <tilth/output/run_mcap.hpp>
#include <tilth/sensor/point_cloud2.hpp>
#include <tilth/sensor/pose_message.hpp>
#include <tilth/sensor/ros2_definitions.hpp>

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

}  // namespace

void write_run_mcap(const std::filesystem::path& path, const RunRecord& record) {
  const Trajectory& trajectory = record.trajectory;
  const Frames frames;
  McapWriter file(path);
  const std::uint32_t path_topic = add_topic(file, "/path", path_type());
  const std::uint32_t map_topic = add_topic(file, "/map", point_cloud2_type());
  const std::uint32_t tf_topic = add_topic(file, "/tf", tf_type());
  const std::uint32_t odometry_topic = add_topic(file, "/odometry", odometry_type());
  const double begin = trajectory.empty() ? 0.0 : trajectory.front().stamp;
  file.write(path_topic, nanoseconds(begin), serialize_path(trajectory, frames));
  file.write(map_topic, nanoseconds(begin),
             serialize_point_cloud2({begin, frames.world, record.map.records()}, Serialization::cdr));
  const std::size_t without_row = trajectory.size() - std::min(trajectory.size(), record.scans.rows.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Vector6d variances = i < without_row ? Vector6d::Zero() : record.scans.rows[i - without_row].variances;
    const std::uint64_t stamp = nanoseconds(trajectory[i].stamp);
    file.write(tf_topic, stamp, serialize_tf(trajectory[i], frames));
    file.write(odometry_topic, stamp, serialize_odometry(trajectory[i], variances, frames));
  }
  file.close();
}

}  // namespace tilth
