// Which files a run writes beside those it always writes.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include <tilth/core/options.hpp>
#include <tilth/freespace/occupancy_options.hpp>
#include <tilth/io/utm_origin.hpp>

namespace tilth {

struct OutputOptions {
  std::string map_format = "pcd";
  double octomap_resolution = 0.1;
  int tile = 20;
  std::string origin = {};
  bool mcap = false;
  std::uint64_t mcap_points = 5000;
  bool grid = false;
  OccupancyOptions occupancy = {};
};

template <class V>
void visit(OutputOptions& o, V&& v) {
  v("map_format", o.map_format,
    "[-] files of the map: of pcd, ply, las, bt (OctoMap) and tiles (Autoware) one or several, as pcd,bt");
  v("octomap_resolution", o.octomap_resolution, Bounds{0.01, 10}, "[m] edge of the smallest cells of map.bt");
  v("tile", o.tile, Bounds{1, 10000}, "[m] edge of the tiles");
  v("origin", o.origin,
    "[m] where the map begins, for map.las: UTM zone,easting,northing,height[,degrees from east to x]; empty: nowhere");
  v("mcap", o.mcap, "[-] also write run.mcap: scans, poses, path and map as ROS 2 messages, for Foxglove");
  v("mcap_points", o.mcap_points, Bounds{0, 1e9}, "[points] of each scan that go into run.mcap at most; 0: none");
  v("grid", o.grid, "[-] also write map.pgm and map.yaml: the floor plan, as map_server and nav2 read it");
  visit(o.occupancy, v);
}

/// Where the map lies on the Earth, where that is said. Throws Error naming what is wrong with it.
std::optional<UtmOrigin> origin_of(const OutputOptions& options);

/// The formats named in `map_format`. Throws Error on one that is not known, and where there is none.
std::set<std::string> map_formats(const OutputOptions& options);

}  // namespace tilth
