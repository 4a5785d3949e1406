#include <algorithm>

#include <tilth/core/error.hpp>
#include <tilth/freespace/floor_columns.hpp>
#include <tilth/freespace/occupancy_grid.hpp>

namespace tilth {
namespace {

constexpr float kRobot = 0.2F;  // [m] about the way that was free, or the robot would not have passed
constexpr int kFullHole = 6;    // of eight cells about a small hole that are free

void classify(const FloorColumns& columns, OccupancyGrid& grid) {
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      if (columns.is_obstacle(grid.number(c, r)))
        grid.cells[grid.number(c, r)] = Occupancy::occupied;
      else if (columns.was_seen_free(grid.number(c, r)))
        grid.cells[grid.number(c, r)] = Occupancy::free;
    }
  }
}

/// Frees what the robot drove over.
std::vector<std::size_t> drive(std::span<const Eigen::Vector3f> way, OccupancyGrid& grid) {
  std::vector<std::size_t> driven;
  const int radius = int(kRobot / float(grid.resolution));
  for (const Eigen::Vector3f& p : way) {
    const Eigen::Vector2i at =
        ((p.head<2>().cast<double>() - grid.origin) / grid.resolution).array().floor().cast<int>();
    for (int i = 0; i < (2 * radius + 1) * (2 * radius + 1); ++i) {
      const int dc = i % (2 * radius + 1) - radius, dr = i / (2 * radius + 1) - radius;
      const int c = at.x() + dc, r = at.y() + dr;
      if (!grid.contains(c, r) || dc * dc + dr * dr > radius * radius) continue;
      if (grid.at(c, r) != Occupancy::occupied) grid.cells[grid.number(c, r)] = Occupancy::free;
      driven.push_back(grid.number(c, r));
    }
  }
  return driven;
}

/// What is free but cannot be reached from the way was seen through a window, a mirror or by a stray beam.
void keep_reached(std::vector<std::size_t> reached, OccupancyGrid& grid) {
  std::vector<std::uint8_t> kept(grid.cells.size(), 0);
  for (const std::size_t n : reached) kept[n] = 1;
  while (!reached.empty()) {
    const std::size_t n = reached.back();
    reached.pop_back();
    const int column = int(n % std::size_t(grid.columns)), row = int(n / std::size_t(grid.columns));
    for (int side = 0; side < 4; ++side) {
      const int c = column + (side == 0) - (side == 1), r = row + (side == 2) - (side == 3);
      if (!grid.contains(c, r) || kept[grid.number(c, r)] != 0 || grid.at(c, r) != Occupancy::free) continue;
      kept[grid.number(c, r)] = 1;
      reached.push_back(grid.number(c, r));
    }
  }
  for (std::size_t n = 0; n < kept.size(); ++n) {
    if (kept[n] == 0 && grid.cells[n] == Occupancy::free) grid.cells[n] = Occupancy::unknown;
  }
}

int free_about(const OccupancyGrid& grid, int column, int row) {
  int free = 0;
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) free += grid.contains(c, r) && grid.at(c, r) == Occupancy::free;
  }
  return free;
}

/// Cells that no beam happened to cross, among cells that are free.
void fill_holes(const FloorColumns& columns, OccupancyGrid& grid) {
  const OccupancyGrid before = grid;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      const std::size_t n = grid.number(c, r);
      if (before.cells[n] != Occupancy::unknown || !columns.is_bare(n)) continue;
      if (free_about(before, c, r) >= kFullHole) grid.cells[n] = Occupancy::free;
    }
  }
}

}  // namespace

OccupancyGrid occupancy_of(std::span<const SeenPoint> points, std::span<const Eigen::Vector3f> way,
                           const OccupancyOptions& options) {
  if (options.low >= options.high) throw Error("option grid_low", "must lie below grid_high");
  OccupancyGrid grid;
  grid.resolution = options.resolution;
  if (way.empty()) return grid;
  FloorColumns columns(points, way, options);
  for (const SeenPoint& seen : points) columns.add_beam(seen);
  grid = columns.layout();
  classify(columns, grid);
  keep_reached(drive(way, grid), grid);
  fill_holes(columns, grid);
  return grid;
}

}  // namespace tilth
