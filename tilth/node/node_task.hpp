// What a node makes of the clouds from one beginning to the next: a map, or the way in a saved one.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <tilth/core/se3.hpp>
#include <tilth/localization/place_map.hpp>
#include <tilth/node/node_outlet.hpp>
#include <tilth/node/node_settings.hpp>
#include <tilth/sources/cloud_inbox.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

/// What must outlive a task.
struct NodeSurroundings {
  const NodeSettings& settings;
  const CloudInbox& inbox;
  NodeOutlet& outlet;
};

class NodeTask {
 public:
  virtual ~NodeTask() = default;

  /// Takes scans until there are no more. Throws Error where it cannot go on.
  virtual void run() = 0;

  /// As those of SlamNode, with where the robot is said to be. Only while run() waits for a scan.
  virtual std::string save_map() = 0;
  virtual std::string localize(const std::optional<Pose>& T_map_body) = 0;
};

/// `source` has the scans of `lidar_frame`.
std::unique_ptr<NodeTask> mapping_task(const NodeSurroundings& around, std::unique_ptr<ScanSource> source,
                                       const std::string& lidar_frame);

/// In `map`, which must outlive the task.
std::unique_ptr<NodeTask> localizing_task(const NodeSurroundings& around, std::unique_ptr<ScanSource> source,
                                          const std::string& lidar_frame, const PlaceMap& map);

}  // namespace tilth
