// Which files a run writes beside those it always writes.
#pragma once

#include <set>
#include <string>

#include <tilth/core/options.hpp>

namespace tilth {

struct OutputOptions {
  std::string map_format = "pcd";
  bool mcap = false;
};

template <class V>
void visit(OutputOptions& o, V&& v) {
  v("map_format", o.map_format, "[-] files of the map: of pcd, ply and las one or several, as pcd,las");
  v("mcap", o.mcap, "[-] also write run.mcap: poses, path and map as ROS 2 messages, for Foxglove");
}

/// The formats named in `map_format`. Throws Error on one that is not known, and where there is none.
std::set<std::string> map_formats(const OutputOptions& options);

}  // namespace tilth
