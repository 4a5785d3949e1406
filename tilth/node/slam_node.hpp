// SLAM as a node of a robot, without its middleware: PointCloud2 messages in, odometry, transforms, path, scan, map and
// diagnostics out, as the NodeOutlet takes them. With a saved `map`, the robot is found in that instead. ros2/ carries
// both over rcl, ros1/ over roscpp.
//
//   SlamNode node({{"base_from_lidar", "0.2,0,0.5,0,0,0"}}, outlet);
//   node.take(bytes, arrival);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tilth/node/node_options.hpp>
#include <tilth/node/node_outlet.hpp>

namespace tilth {

class NodeWork;

class SlamNode {
 public:
  /// `parameters` as node_parameters() lists them; throws alike, and where the map cannot be read. `outlet` must
  /// outlive the node, and hears from it in threads of its own until it is destroyed.
  SlamNode(const OptionValues& parameters, NodeOutlet& outlet);
  ~SlamNode();
  SlamNode(const SlamNode&) = delete;
  SlamNode& operator=(const SlamNode&) = delete;

  /// A sensor_msgs/PointCloud2, written as the outlet's messages are, that came at `arrival` [ns]. Never waits. The
  /// first eight decide what its fields mean (docs/formats/time_and_ring.md), and are registered then. What cannot be
  /// read is left out, and said. Where stamps fall back by more than a second, it begins anew.
  void take(std::vector<std::byte> cloud, std::uint64_t arrival);

  /// A tf2_msgs/TFMessage of /tf_static, written as clouds are: with `mount_from_tf` it tells how the LiDAR is mounted.
  /// What cannot be read is left out, and said.
  void take_static_transforms(std::span<const std::byte> message);

  /// A geometry_msgs/PoseWithCovarianceStamped in `map_frame`, written likewise: about where the robot is in the saved
  /// `map`. Its place is searched for anew, within `localize.at_radius` of that; its covariance is not looked at. What
  /// is in another frame, cannot be read or has no map to be found in is left out, and said.
  void take_guess(std::span<const std::byte> message);

  /// So many clouds were lost before the next one, says the middleware.
  void lose(std::size_t count);

  /// Forgets map and way, and begins anew with the next clouds.
  void reset();

  /// Writes map.pcd and trajectory.tum into the folder `save_map`, with loop closure also the map that `tilth localize`
  /// takes, in its folder `places`. Registration waits meanwhile. Returns what was written, as a sentence. Throws Error
  /// where there is nothing to write, or it cannot be written.
  std::string save_map();

  /// Forgets where it is in the saved `map`, and searches for it anew; map -> odom is not published until it is found.
  /// Returns what was known before, as a sentence. Throws Error where there is no such map, or no cloud came yet.
  std::string localize();

  /// Any of the above, by its name: those are services, with std_srvs/Trigger.
  struct Answer {
    bool success = false;
    std::string message;  ///< what was done, or why not
  };
  static constexpr std::array<const char*, 3> kServices{"save_map", "localize", "reset"};
  Answer serve(const std::string& name);

  /// All parameters, as they are by now.
  std::vector<NodeParameter> parameters();

  /// Sets those that may be set while it runs (NodeRunningOptions): all of `values`, or none and why.
  Answer set(const OptionValues& values);

 private:
  std::unique_ptr<NodeWork> work_;
};

}  // namespace tilth
