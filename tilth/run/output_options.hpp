// Which files a run writes beside those it always writes.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include <tilth/core/options.hpp>

namespace tilth {

struct OutputOptions {
  std::string map_format = "pcd";
  bool mcap = false;
  std::uint64_t mcap_points = 5000;
};

template <class V>
void visit(OutputOptions& o, V&& v) {
  v("map_format", o.map_format, "[-] files of the map: of pcd, ply and las one or several, as pcd,las");
  v("mcap", o.mcap, "[-] also write run.mcap: scans, poses, path and map as ROS 2 messages, for Foxglove");
  v("mcap_points", o.mcap_points, Bounds{0, 1e9}, "[points] of each scan that go into run.mcap at most; 0: none");
}

/// The formats named in `map_format`. Throws Error on one that is not known, and where there is none.
std::set<std::string> map_formats(const OutputOptions& options);

}  // namespace tilth
