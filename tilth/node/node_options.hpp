// What a node can be asked for: its own options, and under the same names as everywhere those of clouds, map, pipeline,
// loop closure and localisation.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>

namespace tilth {

/// What may be set while a node runs as well.
struct NodeRunningOptions {
  bool publish_tf = true;
  std::uint64_t queue = 5;
  std::uint64_t scan_points = 20'000, map_points = 200'000, path_poses = 5000;
  double map_period = 2.0;  ///< [s]
  std::string save_map = "tilth_map";
};

template <class V>
void visit(NodeRunningOptions& o, V&& v) {
  v("publish_tf", o.publish_tf, "[-] transforms map -> odom -> base on /tf");
  v("queue", o.queue, Bounds{1, 1000}, "[clouds] that may wait to be registered; then the oldest makes way");
  v("scan_points", o.scan_points, Bounds{1, 1e7}, "[points] most of a published scan");
  v("map_points", o.map_points, Bounds{1, 1e8}, "[points] most of a published map");
  v("path_poses", o.path_poses, Bounds{2, 1e7}, "[poses] most of a published path, about");
  v("map_period", o.map_period, Bounds{0, 3600}, "[s] between two maps, and two paths; 0: with every scan");
  v("save_map", o.save_map, "[-] folder that the service save_map writes");
}

struct NodeOptions {
  std::string pipeline;  ///< empty: the default one
  std::string map_frame = "map", odom_frame = "odom", base_frame = "base_link";
  std::string lidar_frame;      ///< empty: that of the clouds
  std::string base_from_lidar;  ///< as parse_mount takes it
  bool mount_from_tf = false;
  bool publish_mount = true;
  bool loop_closure = false;
  bool reliable = false;
  std::string map;  ///< folder; empty: a map is made
  NodeRunningOptions running;
};

template <class V>
void visit(NodeOptions& o, V&& v) {
  v("pipeline", o.pipeline, "[-] see `tilth pipelines`; empty: the default one");
  v("map_frame", o.map_frame, "[-] frame that loop closure corrects");
  v("odom_frame", o.odom_frame, "[-] frame in which the robot's way has no jumps");
  v("base_frame", o.base_frame, "[-] frame of the robot, with base_from_lidar");
  v("lidar_frame", o.lidar_frame,
    "[-] frame of the LiDAR; empty: the frame_id of the first cloud. Clouds of other "
    "frames are left out");
  v("base_from_lidar", o.base_from_lidar,
    "[m, deg] x,y,z,roll,pitch,yaw (or x,y,z,qx,qy,qz,qw) of the LiDAR on the robot; empty: poses are of the LiDAR");
  v("mount_from_tf", o.mount_from_tf,
    "[-] base_from_lidar is what /tf_static tells, looked up when clouds come; nothing is registered before it is "
    "known");
  v("publish_mount", o.publish_mount, "[-] base_from_lidar on /tf_static; false where a robot description does it");
  v("loop_closure", o.loop_closure, "[-] find places seen before, and correct map -> odom");
  v("reliable", o.reliable, "[-] ask the sender for clouds that got lost (reliable QoS); false: sensor data QoS");
  v("map", o.map,
    "[-] folder of a saved map to be found in (`places` of save_map, or of `tilth run --save-map`); empty: a map is "
    "made");
  visit(o.running, v);
}

struct NodeParameter : OptionInfo {
  bool running = false;  ///< may be set while the node runs
};

/// Every parameter of a node with these values, with its bounds. Throws Error naming a key that is unknown or a value
/// that breaks its bounds.
std::vector<NodeParameter> node_parameters(const OptionValues& values);

}  // namespace tilth
