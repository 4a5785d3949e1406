#include <algorithm>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/mcap_writer.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/mcap_sink.hpp>

namespace tilth {

McapSink::McapSink(const std::filesystem::path& path, std::uint64_t points)
    : file_(std::make_unique<McapWriter>(path)), points_(points) {
  for (const NamedTopic& topic : run_topics()) {
    Connection connection;
    connection.topic = topic.name, connection.type = topic.type.name, connection.definition = topic.type.definition;
    topics_.push_back(file_->add_connection(connection));
  }
}

McapSink::~McapSink() = default;

void McapSink::write(RunTopic topic, double stamp, const std::vector<std::byte>& message) {
  file_->write(topics_[std::size_t(topic)], nanoseconds(stamp), message);
}

void McapSink::take(const Scan& scan, const OdometryResult& result, const RunRecord&) {
  if (points_ == 0 || result.filtered.empty() || !problem_.empty()) return;
  try {
    write(RunTopic::scan, result.stamp, scan_message(scan, result, points_));
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
}

void McapSink::finish(const RunRecord& record) {
  if (!problem_.empty()) throw Error("run.mcap", problem_);
  const Trajectory& trajectory = record.trajectory;
  const RunFrames frames = frames_of(record);
  const std::vector<ScanRow>& rows = record.scans.rows;
  const double begin = trajectory.empty() ? 0.0 : trajectory.front().stamp;
  write(RunTopic::path, begin, path_message(trajectory, frames));
  write(RunTopic::map, begin, map_message(begin, record.map.records(), names_in(frames).world));
  const std::size_t without_row = trajectory.size() - std::min(trajectory.size(), rows.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const StampedPose& pose = trajectory[i];
    const ScanRow* const row = i < without_row ? nullptr : &rows[i - without_row];
    write(RunTopic::tf, pose.stamp, tf_message(pose, frames));
    write(RunTopic::odometry, pose.stamp, odometry_message(pose, row ? row->covariance : Matrix6d::Zero(), frames));
    if (row) write(RunTopic::diagnostics, pose.stamp, diagnostics_message(*row));
  }
  file_->close();
}

}  // namespace tilth
