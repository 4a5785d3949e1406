#include <algorithm>
#include <cmath>
#include <string>

#include <tilth/core/error.hpp>
#include <tilth/freespace/floor_columns.hpp>

namespace tilth {
namespace {

constexpr float kReach = 30;        // [m] from the sensor, over the ground, that anything is taken from
constexpr float kBeforeEnd = 0.1F;  // [m] of a beam that are not called free: noise, and the width of the beam
constexpr float kOver = 0.1F;       // [m] that a beam must pass above an obstacle to go on
constexpr int kFewestBeams = 2;     // that see a cell free
constexpr int kFewestPoints = 4;    // of an obstacle in a cell and those about it
constexpr double kAbout = 0.1;      // [m] about a cell: one ring along an edge leaves a point in each voxel
constexpr double kMostCells = 250e6;
constexpr float kBelowGround = 0.5F;  // [m] under which a beam is thought to be a stray one
constexpr int kMost = 65535;          // counted

bool is_near(const SeenPoint& seen) {
  return (seen.point - seen.from).head<2>().norm() < kReach;  // false for what is not finite
}

OccupancyGrid laid_out(std::span<const SeenPoint> points, std::span<const Eigen::Vector3f> way, double resolution) {
  Eigen::Vector2d low = way.front().head<2>().cast<double>(), high = low;
  const auto reach = [&](const Eigen::Vector3f& p) {
    low = low.cwiseMin(p.head<2>().cast<double>()), high = high.cwiseMax(p.head<2>().cast<double>());
  };
  std::for_each(way.begin(), way.end(), reach);
  for (const SeenPoint& seen : points) {
    if (is_near(seen)) reach(seen.point);
  }
  OccupancyGrid grid;
  grid.resolution = resolution;
  grid.origin = resolution * ((low / resolution).array().floor() - 2);
  const Eigen::Vector2d size = ((high - grid.origin) / resolution).array().floor() + 3;
  if (size.prod() > kMostCells) {
    throw Error("option grid_resolution", "is too fine for a map of " + std::to_string(int(high.x() - low.x())) +
                                              " m by " + std::to_string(int(high.y() - low.y())) +
                                              " m: the grid would have more than 250 million cells");
  }
  grid.columns = int(size.x()), grid.rows = int(size.y());
  grid.cells.assign(std::size_t(grid.columns) * std::size_t(grid.rows), Occupancy::unknown);
  return grid;
}

GroundHeight ground_of(std::span<const SeenPoint> points, std::span<const Eigen::Vector3f> way,
                       const OccupancyGrid& grid) {
  std::vector<Eigen::Vector3f> near;
  for (const SeenPoint& seen : points) {
    if (!seen.moving && is_near(seen)) near.push_back(seen.point);
  }
  const Eigen::Vector2d size = grid.resolution * Eigen::Vector2d(grid.columns, grid.rows);
  return {near, way, grid.origin.cast<float>(), (grid.origin + size).cast<float>()};
}

}  // namespace

FloorColumns::FloorColumns(std::span<const SeenPoint> points, std::span<const Eigen::Vector3f> way,
                           const OccupancyOptions& options)
    : options_(options),
      layout_(laid_out(points, way, options.resolution)),
      ground_(ground_of(points, way, layout_)),
      columns_(layout_.cells.size()) {
  for (const SeenPoint& seen : points) add_point(seen);
  find_obstacles();
}

float FloorColumns::above_ground(const Eigen::Vector3f& p) const {
  return p.z() - ground_.at(p.x(), p.y());
}

void FloorColumns::add_point(const SeenPoint& seen) {
  if (seen.moving || !is_near(seen)) return;
  const float height = above_ground(seen.point);
  if (height < float(options_.low) || height > float(options_.high)) return;
  const Eigen::Vector2f at = in_cells(seen.point);
  Column& column = columns_[layout_.number(int(at.x()), int(at.y()))];
  column.obstacles = std::uint16_t(std::min(column.obstacles + 1, kMost));
  column.top = std::max(column.top, seen.point.z());
}

/// Cells that the beam crosses lower than any obstacle is high, as long as none that is as high as the beam stands in
/// its way: over a bed beams pass that tell nothing of it. One that ends on the floor is sure, and free up to its end.
void FloorColumns::add_beam(const SeenPoint& seen) {
  if (!is_near(seen)) return;
  const Eigen::Vector2f from = in_cells(seen.from), to = in_cells(seen.point);
  const bool on_floor = !seen.moving && above_ground(seen.point) < float(options_.low);
  const float length = (to - from).norm(), end = length - (on_floor ? 0 : kBeforeEnd / float(layout_.resolution));
  const Eigen::Vector2f step = (to - from) / std::max(length, 1e-6F);
  const float rise = (seen.point.z() - seen.from.z()) / std::max(length, 1e-6F);
  for (float along = 0; along < end; along += 1) {
    const Eigen::Vector2f at = from + along * step;
    if (!layout_.contains(int(at.x()), int(at.y()))) return;
    const std::size_t number = layout_.number(int(at.x()), int(at.y()));
    Column& column = columns_[number];
    const float z = seen.from.z() + along * rise;
    if (is_obstacle(number)) {
      if (z < column.top + kOver) return;
      continue;
    }
    const Eigen::Vector2f place = layout_.origin.cast<float>() + at * float(layout_.resolution);
    const float height = above_ground({place.x(), place.y(), z});
    if (height < -kBelowGround) return;
    if (height < float(options_.low))
      column.beams = std::uint16_t(std::min(column.beams + (on_floor ? kFewestBeams : 1), kMost));
  }
}

bool FloorColumns::has_points_enough(int column, int row) const {
  if (columns_[layout_.number(column, row)].obstacles == 0) return false;
  const int reach = std::max(1, int(std::lround(kAbout / layout_.resolution)));
  int about = 0;
  for (int r = std::max(0, row - reach); r <= std::min(layout_.rows - 1, row + reach); ++r) {
    for (int c = std::max(0, column - reach); c <= std::min(layout_.columns - 1, column + reach); ++c)
      about += columns_[layout_.number(c, r)].obstacles;
  }
  return about >= kFewestPoints;
}

void FloorColumns::find_obstacles() {
  obstacles_.assign(columns_.size(), 0);
  for (int r = 0; r < layout_.rows; ++r) {
    for (int c = 0; c < layout_.columns; ++c) obstacles_[layout_.number(c, r)] = std::uint8_t(has_points_enough(c, r));
  }
  const std::vector<std::uint8_t> found = obstacles_;
  const std::size_t width = std::size_t(layout_.columns);
  for (int r = 1; r + 1 < layout_.rows; ++r) {
    for (int c = 1; c + 1 < layout_.columns; ++c) {
      const std::size_t n = layout_.number(c, r);
      for (const std::size_t step : {std::size_t{1}, width, width - 1, width + 1}) {
        if (found[n - step] == 0 || found[n + step] == 0 || found[n] != 0) continue;
        obstacles_[n] = 1;
        columns_[n].top = std::min(columns_[n - step].top, columns_[n + step].top);
      }
    }
  }
}

bool FloorColumns::was_seen_free(std::size_t number) const {
  return columns_[number].beams >= kFewestBeams;
}

}  // namespace tilth
