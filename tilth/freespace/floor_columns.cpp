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
constexpr double kMostCells = 250e6;
constexpr float kBelowGround = 0.5F;    // [m] under which a beam is thought to be a stray one
constexpr std::uint16_t kMost = 65535;  // counted

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

void FloorColumns::add_point(const SeenPoint& seen) {
  if (seen.moving || !is_near(seen)) return;
  const Eigen::Vector2f at = in_cells(seen.point);
  Column& column = columns_[layout_.number(int(at.x()), int(at.y()))];
  const float height = seen.point.z() - ground_.at(seen.point.x(), seen.point.y());
  if (height > float(options_.high) || height < -kBelowGround) return;
  std::uint16_t& count = height < float(options_.low) ? column.floors : column.obstacles;
  count = std::uint16_t(std::min(count + 1, int(kMost)));
  if (height >= float(options_.low)) column.top = std::max(column.top, seen.point.z());
}

/// Cells along the beam, as long as it is below the upper height and no obstacle that is as high stands in its way.
void FloorColumns::add_beam(const SeenPoint& seen) {
  if (!is_near(seen)) return;
  const Eigen::Vector2f from = in_cells(seen.from), to = in_cells(seen.point);
  const auto resolution = float(layout_.resolution);
  const float length = (to - from).norm(), end = length - kBeforeEnd / resolution;
  const Eigen::Vector2f step = (to - from) / std::max(length, 1e-6F);
  const float rise = (seen.point.z() - seen.from.z()) / std::max(length, 1e-6F);
  for (float along = 0; along < end; along += 1) {
    const int c = int(from.x() + along * step.x()), r = int(from.y() + along * step.y());
    if (!layout_.contains(c, r)) return;
    Column& column = columns_[layout_.number(c, r)];
    const float z = seen.from.z() + along * rise;
    if (is_obstacle(layout_.number(c, r))) {
      if (z < column.top + kOver) return;
      continue;
    }
    const float x = float(layout_.origin.x()) + (float(c) + 0.5F) * resolution;
    const float y = float(layout_.origin.y()) + (float(r) + 0.5F) * resolution;
    const float height = z - ground_.at(x, y);
    if (height < -kBelowGround) return;
    if (height <= float(options_.high)) column.beams = std::uint16_t(std::min(column.beams + 1, int(kMost)));
  }
}

bool FloorColumns::has_points_enough(int column, int row) const {
  if (columns_[layout_.number(column, row)].obstacles == 0) return false;
  int about = 0;
  for (int r = std::max(0, row - 1); r <= std::min(layout_.rows - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(layout_.columns - 1, column + 1); ++c)
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
  const Column& column = columns_[number];
  return column.beams >= kFewestBeams || (column.beams > 0 && column.floors > 0);
}

}  // namespace tilth
