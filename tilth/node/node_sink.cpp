#include <chrono>
#include <utility>

#include <tilth/messages/pose_message.hpp>
#include <tilth/node/node_sink.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/pipeline.hpp>
#include <tilth/run/run_messages.hpp>

namespace tilth {
namespace {

constexpr double kBetweenComplaints = 1.0;  // [s] of clouds that are missing

std::string missing_sentence(const InboxCounts& counts) {
  const std::string clouds = std::to_string(counts.received + counts.lost) + " clouds so far";
  std::string text;
  if (counts.dropped > 0) text = "this computer is too slow: " + std::to_string(counts.dropped) + " dropped";
  if (counts.lost > 0)
    text += (text.empty() ? "" : ", ") + std::to_string(counts.lost) + " lost on the way (reliable:=true asks again)";
  return text + " of " + clouds;
}

bool is_corrected(const Slam* slam) {
  return slam != nullptr && slam->corrected_so_far();
}

}  // namespace

std::vector<PublishedTopic> node_topics() {
  return {{NodeTopic::odometry, "~/odometry", "nav_msgs/msg/Odometry"},
          {NodeTopic::tf, "/tf", "tf2_msgs/msg/TFMessage"},
          {NodeTopic::tf_static, "/tf_static", "tf2_msgs/msg/TFMessage", true},
          {NodeTopic::path, "~/path", "nav_msgs/msg/Path"},
          {NodeTopic::scan, "~/scan", "sensor_msgs/msg/PointCloud2"},
          {NodeTopic::map, "~/map", "sensor_msgs/msg/PointCloud2", true},
          {NodeTopic::diagnostics, "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"}};
}

Trajectory way_in_map(const RunRecord& record, const Slam* slam) {
  return slam != nullptr ? slam->trajectory_so_far() : record.trajectory;
}

MapBuilder map_of(const RunRecord& record, const Slam* slam) {
  MapBuilder map = record.map;
  if (is_corrected(slam)) map.move(corrections(record.trajectory, slam->trajectory_so_far()));
  return map;
}

NodeSink::NodeSink(const Surroundings& around, std::string lidar_frame)
    : around_(around),
      lidar_frame_(std::move(lidar_frame)),
      body_frame_(around.settings.T_base_lidar ? around.settings.node.base_frame : lidar_frame_) {}

void NodeSink::take(const Scan& scan, const OdometryResult& result, const RunRecord& record) {
  send_pose(record);
  send_diagnostics(record);
  if (!result.filtered.empty() && around_.outlet.wanted(NodeTopic::scan))
    around_.outlet.publish(NodeTopic::scan,
                           scan_message(scan, result, around_.settings.node.scan_points, lidar_frame_));
  if (!sent_whole_ || since_whole_.seconds() >= around_.settings.node.map_period) send_path_and_map(record);
}

void NodeSink::send_pose(const RunRecord& record) {
  const NodeOptions& node = around_.settings.node;
  const StampedPose& pose = record.trajectory.back();
  const std::optional<Pose>& mount = record.T_base_lidar;
  const Pose T_odom_body = pose_of_base(pose.T_world_lidar, mount);
  const Frames frames{node.odom_frame, body_frame_};
  around_.outlet.publish(NodeTopic::odometry,
                         serialize_odometry({pose.stamp, T_odom_body},
                                            covariance_of_base(record.scans.rows.back().covariance, mount), frames));
  if (mount && node.publish_mount && !std::exchange(mount_sent_, true)) {
    const StampedTransform fixed{pose.stamp, {body_frame_, lidar_frame_}, *mount};
    around_.outlet.publish(NodeTopic::tf_static, serialize_tf({&fixed, 1}));
  }
  if (!node.publish_tf) return;
  const Pose T_map_odom = around_.slam != nullptr ? around_.slam->T_map_odom() : Pose(Pose::Identity());
  const StampedTransform both[] = {{pose.stamp, {node.map_frame, node.odom_frame}, T_map_odom},
                                   {pose.stamp, frames, T_odom_body}};
  around_.outlet.publish(NodeTopic::tf, serialize_tf(both));
}

void NodeSink::send_diagnostics(const RunRecord& record) {
  const InboxCounts counts = around_.inbox.counts();
  Diagnostic track = track_diagnostic(record.scans.rows.back());
  track.values.emplace_back("clouds_received", std::to_string(counts.received));
  track.values.emplace_back("clouds_dropped", std::to_string(counts.dropped));
  track.values.emplace_back("clouds_lost", std::to_string(counts.lost));
  track.values.emplace_back("clouds_skipped", std::to_string(record.skipped.size()));
  const std::string missing = missing_sentence(counts);
  if (counts.dropped + counts.lost > missing_) {
    track.message += "; " + missing;
    if (track.level == DiagnosticLevel::ok) track.level = DiagnosticLevel::warn;
    if (missing_ == 0 || since_complaint_.seconds() > kBetweenComplaints) {
      around_.outlet.warn(missing);
      since_complaint_ = Stopwatch();
    }
    missing_ = counts.dropped + counts.lost;
  }
  around_.outlet.publish(NodeTopic::diagnostics, serialize_diagnostic(track));
}

void NodeSink::send_path_and_map(const RunRecord& record) {
  const NodeOptions& node = around_.settings.node;
  if (around_.outlet.wanted(NodeTopic::path)) {
    const Trajectory way = thinned(way_in_map(record, around_.slam), node.path_poses);
    around_.outlet.publish(NodeTopic::path,
                           serialize_path(poses_of_base(way, record.T_base_lidar), {node.map_frame, body_frame_}));
  }
  send_map(record);
  since_whole_ = Stopwatch();
  sent_whole_ = true;
}

/// A map that was corrected is moved in the background, from a copy, unless the last one is still on its way.
void NodeSink::send_map(const RunRecord& record) {
  const NodeOptions& node = around_.settings.node;
  const auto send = [outlet = &around_.outlet, most = std::size_t(node.map_points), frame = node.map_frame,
                     stamp = record.trajectory.back().stamp](const MapBuilder& map) {
    outlet->publish(NodeTopic::map, map_message(stamp, map.thinned_records(most), frame));
  };
  if (!is_corrected(around_.slam)) return send(record.map);
  if (map_.valid()) {
    if (map_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    map_.get();
  }
  map_ = std::async(
      std::launch::async,
      [send, map = record.map, moves = corrections(record.trajectory, around_.slam->trajectory_so_far())]() mutable {
        map.move(moves);
        send(map);
      });
}

void NodeSink::finish(const RunRecord& record) {
  if (record.trajectory.empty()) return;
  if (map_.valid()) map_.get();
  if (around_.slam != nullptr) around_.slam->loops();  // until all are closed
  send_path_and_map(record);
  if (map_.valid()) map_.get();
}

}  // namespace tilth
