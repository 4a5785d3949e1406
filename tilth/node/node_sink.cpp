#include <chrono>
#include <utility>

#include <tilth/messages/pose_estimate.hpp>
#include <tilth/messages/pose_message.hpp>
#include <tilth/node/node_sink.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/pipeline.hpp>
#include <tilth/run/run_messages.hpp>

namespace tilth {
namespace {

constexpr double kBetweenComplaints = 1.0;  // [s] of clouds that are missing

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
          {NodeTopic::diagnostics, "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"},
          {NodeTopic::pose, "~/pose", "geometry_msgs/msg/PoseWithCovarianceStamped"}};
}

Trajectory way_in_map(const RunRecord& record, const Slam* slam) {
  return slam != nullptr ? slam->trajectory_so_far() : record.trajectory;
}

MapBuilder map_of(const RunRecord& record, const Slam* slam) {
  MapBuilder map = record.map;
  if (is_corrected(slam)) map.move(corrections(record.trajectory, slam->trajectory_so_far()));
  return map;
}

NodeSink::NodeSink(const NodeSurroundings& around, const Slam* slam, std::string lidar_frame)
    : around_(around),
      slam_(slam),
      serialization_(around.outlet.serialization()),
      lidar_frame_(std::move(lidar_frame)),
      body_frame_(around.settings.T_base_lidar ? around.settings.node.base_frame : lidar_frame_),
      T_odom_lidar_(around.settings.T_base_lidar.value_or(Pose::Identity())) {}

void NodeSink::take(const Scan& scan, const OdometryResult& result, const RunRecord& record) {
  const NodeOptions& node = around_.settings.node;
  const NodeRunningOptions& running = node.running;
  stamp_ = result.stamp;
  T_odom_lidar_ = result.T_world_lidar;
  send_odometry(result);
  if (node.publish_mount && !std::exchange(mount_sent_, true)) send_mount(result.stamp);
  if (running.publish_tf) send_tf(result.stamp, T_map_odom(record));
  send_place(record);
  send_diagnostics(record);
  if (!result.filtered.empty() && around_.outlet.wanted(NodeTopic::scan))
    around_.outlet.publish(NodeTopic::scan,
                           scan_message(scan, result, running.scan_points, lidar_frame_, serialization_));
  if (!sent_whole_ || since_whole_.seconds() >= running.map_period) send_path_and_map(record);
}

/// Nothing where the place in a saved map is not known.
std::optional<Pose> NodeSink::T_map_odom(const RunRecord& record) const {
  if (!record.localization) return slam_ != nullptr ? slam_->T_map_odom() : Pose(Pose::Identity());
  const std::optional<Pose>& T_map_lidar = record.localization->rows.back().T_map_lidar;
  if (!T_map_lidar) return std::nullopt;
  return *T_map_lidar * T_odom_lidar_.inverse();
}

void NodeSink::send_odometry(const OdometryResult& result) {
  const std::optional<Pose>& mount = around_.settings.T_base_lidar;
  const Matrix6d of_lidar = result.covariance.value_or(result.alignment.covariance);
  around_.outlet.publish(
      NodeTopic::odometry,
      serialize_odometry({result.stamp, pose_of_base(result.T_world_lidar, mount)}, covariance_of_base(of_lidar, mount),
                         {around_.settings.node.odom_frame, body_frame_}, serialization_));
}

void NodeSink::send_mount(double stamp) {
  if (!around_.settings.T_base_lidar) return;
  const StampedTransform fixed{stamp, {body_frame_, lidar_frame_}, *around_.settings.T_base_lidar};
  around_.outlet.publish(NodeTopic::tf_static, serialize_tf({&fixed, 1}, serialization_));
}

void NodeSink::send_tf(double stamp, const std::optional<Pose>& T_map_odom) {
  const NodeOptions& node = around_.settings.node;
  std::vector<StampedTransform> transforms;
  if (T_map_odom) transforms.push_back({stamp, {node.map_frame, node.odom_frame}, *T_map_odom});
  transforms.push_back(
      {stamp, {node.odom_frame, body_frame_}, pose_of_base(T_odom_lidar_, around_.settings.T_base_lidar)});
  around_.outlet.publish(NodeTopic::tf, serialize_tf(transforms, serialization_));
}

/// In a saved map, where it is known.
void NodeSink::send_place(const RunRecord& record) {
  if (!record.localization || !record.localization->rows.back().T_map_lidar) return;
  const LocalizationRow& row = record.localization->rows.back();
  const std::optional<Pose>& mount = around_.settings.T_base_lidar;
  around_.outlet.publish(NodeTopic::pose, serialize_pose_estimate({row.stamp, pose_of_base(*row.T_map_lidar, mount)},
                                                                  covariance_of_base(row.covariance, mount),
                                                                  around_.settings.node.map_frame, serialization_));
}

void NodeSink::send_diagnostics(const RunRecord& record) {
  const InboxCounts counts = around_.inbox.counts();
  Diagnostic track = record.localization ? place_diagnostic(record.localization->rows.back())
                                         : track_diagnostic(record.scans.rows.back());
  track.values.emplace_back("clouds_received", std::to_string(counts.received));
  track.values.emplace_back("clouds_dropped", std::to_string(counts.dropped));
  track.values.emplace_back("clouds_lost", std::to_string(counts.lost));
  track.values.emplace_back("clouds_skipped", std::to_string(record.skipped.size()));
  const std::string missing = missing_sentence(counts);
  if (counts.missing() > missing_) {
    track.message += "; " + missing;
    if (track.level == DiagnosticLevel::ok) track.level = DiagnosticLevel::warn;
    if (missing_ == 0 || since_complaint_.seconds() > kBetweenComplaints) {
      around_.outlet.warn(missing);
      since_complaint_ = Stopwatch();
    }
    missing_ = counts.missing();
  }
  around_.outlet.publish(NodeTopic::diagnostics, serialize_diagnostic(track, serialization_));
}

void NodeSink::send_path_and_map(const RunRecord& record) {
  const NodeOptions& node = around_.settings.node;
  if (around_.outlet.wanted(NodeTopic::path)) {
    const Trajectory way = thinned(way_in_map(record, slam_), node.running.path_poses);
    around_.outlet.publish(NodeTopic::path, serialize_path(poses_of_base(way, record.T_base_lidar),
                                                           {node.map_frame, body_frame_}, serialization_));
  }
  if (!record.localization || !sent_whole_) send_map(record);  // a saved map stays as it is
  since_whole_ = Stopwatch();
  sent_whole_ = true;
}

/// A map that was corrected is moved in the background, from a copy, unless the last one is still on its way.
void NodeSink::send_map(const RunRecord& record) {
  const NodeOptions& node = around_.settings.node;
  const auto send = [outlet = &around_.outlet, most = std::size_t(node.running.map_points), frame = node.map_frame,
                     stamp = stamp_, serialization = serialization_](const MapBuilder& map) {
    outlet->publish(NodeTopic::map, map_message(stamp, map.thinned_records(most), frame, serialization));
  };
  if (!is_corrected(slam_)) return send(record.map);
  if (map_.valid()) {
    if (map_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    map_.get();
  }
  map_ = std::async(std::launch::async, [send, map = record.map,
                                         moves = corrections(record.trajectory, slam_->trajectory_so_far())]() mutable {
    map.move(moves);
    send(map);
  });
}

void NodeSink::finish(const RunRecord& record) {
  if (!sent_whole_) return;
  if (map_.valid()) map_.get();
  if (slam_ != nullptr) slam_->loops();  // until all are closed
  send_path_and_map(record);
  if (map_.valid()) map_.get();
}

}  // namespace tilth
