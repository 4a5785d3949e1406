// What the 3D view of a report shows: the map, packed small, and the ways through it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/report/packed_map.hpp>

namespace tilth {

/// A way through the map, in its frame.
struct MapPath {
  std::string name;
  Trajectory poses;
  bool truth = false;
};

struct MapView {
  PackedMap points;                    ///< the number of a point's scan is that of a pose of paths.front()
  PackedMap moving;                    ///< points that moved, in one layer at most
  std::vector<MapPath> paths;          ///< the estimate first
  std::vector<std::size_t> keyframes;  ///< poses of paths.front()
  std::vector<std::pair<std::size_t, std::size_t>> closures;  ///< pairs of such poses that a loop closure joins
};

}  // namespace tilth
