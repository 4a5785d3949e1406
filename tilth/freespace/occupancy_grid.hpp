// A floor plan of a map: cells that beams saw free, cells with an obstacle between two heights above the local ground,
// and cells of which nothing is known. Made of the points of the map alone, each with the place that it was seen from:
// so a corrected map gives a corrected plan. About 1 us a point. docs/grid.md has the rules.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <tilth/freespace/occupancy_options.hpp>

namespace tilth {

enum class Occupancy : std::uint8_t { unknown, free, occupied };

/// A grid over the xy plane of the world; row 0 has the smallest y.
struct OccupancyGrid {
  double resolution = 0.0;                           ///< [m] edge of a cell
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< [m] outer corner of the cell (0, 0)
  int columns = 0, rows = 0;
  std::vector<Occupancy> cells;  ///< row after row

  bool contains(int column, int row) const { return column >= 0 && row >= 0 && column < columns && row < rows; }
  std::size_t number(int column, int row) const {
    return std::size_t(row) * std::size_t(columns) + std::size_t(column);
  }
  Occupancy at(int column, int row) const { return cells[number(column, row)]; }
};

/// A point of the map in the world [m], and the place that it was seen from.
struct SeenPoint {
  Eigen::Vector3f point, from;
  bool moving = false;  ///< then it is no obstacle, but what lies before it is free
};

/// The plan of `points`, seen by a sensor that went along `way` [m]; z points up. Throws Error where the grid would
/// have more cells than can be held, or `low` lies above `high`.
OccupancyGrid occupancy_of(std::span<const SeenPoint> points, std::span<const Eigen::Vector3f> way,
                           const OccupancyOptions& options);

}  // namespace tilth
