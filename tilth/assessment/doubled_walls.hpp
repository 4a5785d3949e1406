// Walls that a map holds twice, as it does where the track erred between two visits: two parallel layers less than 30
// cm apart, seen from the same side through one another. A surface hides what is behind it, so that no scene has them,
// but for panes of glass and hedges. O(n).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tilth {

/// A point of a map [m], the place that it was seen from [m] and the number of its scan.
struct ScannedPoint {
  Eigen::Vector3f point, from;
  std::uint32_t scan = 0;
};

struct DoubledWall {
  Eigen::Vector3f place;   ///< [m] between the layers
  double gap = 0.0;        ///< [m] from layer to layer
  std::uint32_t scan = 0;  ///< of the later layer: its median
  std::size_t cells = 1;   ///< of 0.8 m that it fills
};

struct DoubledWalls {
  std::size_t planes = 0, doubled = 0;  ///< cells that hold one surface or two, and two
  std::vector<DoubledWall> walls;       ///< cells that touch one another put together, the largest first
};

DoubledWalls doubled_walls(std::span<const ScannedPoint> points);

}  // namespace tilth
