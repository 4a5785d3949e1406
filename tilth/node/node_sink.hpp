// The run of a node as messages: odometry, transforms and diagnostics with every scan, path and map from time to time.
#pragma once

#include <cstddef>
#include <future>
#include <span>
#include <string>
#include <vector>

#include <tilth/node/cloud_inbox.hpp>
#include <tilth/node/node_outlet.hpp>
#include <tilth/node/node_settings.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/sink.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth {

class NodeSink final : public Sink {
 public:
  /// What must outlive the sink.
  struct Surroundings {
    const NodeSettings& settings;
    const CloudInbox& inbox;
    const Slam* slam;  ///< none without loop closure
    NodeOutlet& outlet;
  };

  NodeSink(const Surroundings& around, std::string lidar_frame);

  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;
  void finish(const RunRecord& record) override;  ///< sends path and map once more

 private:
  void send_pose(const RunRecord& record);
  void send_diagnostics(const RunRecord& record);
  void send_path_and_map(const RunRecord& record);
  void send_map(const RunRecord& record);

  Surroundings around_;
  std::string lidar_frame_, body_frame_;
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
