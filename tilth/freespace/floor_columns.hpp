// What the points of a map say of each column above the ground: obstacles, floor, beams that crossed it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <tilth/freespace/ground_height.hpp>
#include <tilth/freespace/occupancy_grid.hpp>

namespace tilth {

class FloorColumns {
 public:
  /// Throws Error where there would be more columns than can be held.
  FloorColumns(std::span<const SeenPoint> points, std::span<const Eigen::Vector3f> way,
               const OccupancyOptions& options);

  /// Follows the beam to a point.
  void add_beam(const SeenPoint& seen);

  /// Points enough in the column and those about it, or a gap of one column between two that have them.
  bool is_obstacle(std::size_t number) const { return obstacles_[number] != 0; }
  bool is_bare(std::size_t number) const { return columns_[number].obstacles == 0; }
  bool was_seen_free(std::size_t number) const;

  /// Without a cell that is known.
  const OccupancyGrid& layout() const { return layout_; }

 private:
  struct Column {
    std::uint16_t beams = 0, obstacles = 0;
    float top = -std::numeric_limits<float>::infinity();  ///< [m] of its obstacles
  };

  Eigen::Vector2f in_cells(const Eigen::Vector3f& p) const {
    return ((p.head<2>().cast<double>() - layout_.origin) / layout_.resolution).cast<float>();
  }

  float above_ground(const Eigen::Vector3f& p) const;  ///< [m]
  void add_point(const SeenPoint& seen);
  void find_obstacles();
  bool has_points_enough(int column, int row) const;

  OccupancyOptions options_;
  OccupancyGrid layout_;
  GroundHeight ground_;
  std::vector<Column> columns_;
  std::vector<std::uint8_t> obstacles_;
};

}  // namespace tilth
