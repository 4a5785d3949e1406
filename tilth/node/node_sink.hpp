// The run of a node as messages: odometry, transforms and diagnostics with every scan, path and map from time to time.
#pragma once

#include <cstddef>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include <tilth/node/node_task.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/sink.hpp>
#include <tilth/run/stopwatch.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {

class NodeSink final : public Sink {
 public:
  /// `slam` must outlive the sink; none without loop closure, and where a saved map is used.
  NodeSink(const NodeSurroundings& around, const Slam* slam, std::string lidar_frame);

  /// The last pose in odom; before the first, where the LiDAR begins.
  const Pose& T_odom_lidar() const { return T_odom_lidar_; }

  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;
  void finish(const RunRecord& record) override;  ///< sends path and map once more

 private:
  void send_odometry(const OdometryResult& result);
  void send_mount(double stamp);
  void send_tf(double stamp, const std::optional<Pose>& T_map_odom);
  void send_place(const RunRecord& record);
  void send_diagnostics(const RunRecord& record);
  void send_path_and_map(const RunRecord& record);
  void send_map(const RunRecord& record);
  std::optional<Pose> T_map_odom(const RunRecord& record) const;

  NodeSurroundings around_;
  const Slam* slam_;
  Serialization serialization_;
  std::string lidar_frame_, body_frame_;
  Pose T_odom_lidar_;
  double stamp_ = 0.0;       // [s] of it
  std::size_t missing_ = 0;  // clouds that were told of
  bool mount_sent_ = false, sent_whole_ = false;
  Stopwatch since_whole_, since_complaint_;
  std::future<void> map_;  // last: its thread uses the members above
};

/// The way in the map as it is known by now: of `record`, corrected where loops were closed.
Trajectory way_in_map(const RunRecord& record, const Slam* slam);

/// The map of `record`, moved along where loops were closed. O(points) then, else a copy.
MapBuilder map_of(const RunRecord& record, const Slam* slam);

}  // namespace tilth
