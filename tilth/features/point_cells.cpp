#include <algorithm>
#include <cmath>

#include <tilth/core/range_grid.hpp>
#include <tilth/features/point_cells.hpp>

namespace tilth {
namespace {

constexpr int kIntervals = 8;     // of a scan: what a cell holds lies within one of them
constexpr double kAngle = 0.016;  // [rad] that an edge spans at least: some columns of a spinning LiDAR

/// Sums over the points of a cell about its first one.
struct CellSums {
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), sum = Eigen::Vector3d::Zero();
  Symmetric3d products = {};
  double count = 0, time = 0;

  void add(const Eigen::Vector3d& p, double point_time) {
    if (count == 0) first = p;
    const Eigen::Vector3d d = p - first;
    sum += d;
    products += Symmetric3d::product(d, d);
    time += point_time;
    count += 1;
  }

  PointCell cell() const {
    const Eigen::Vector3d offset = sum / count;
    return {{count, first + offset, products - count * Symmetric3d::product(offset, offset)}, float(time / count)};
  }
};

}  // namespace

double cell_duration(const PointCloud& cloud) {
  return duration(cloud) / kIntervals;
}

std::vector<PointCell> point_cells(const PointCloud& cloud, std::span<const std::uint8_t> keep, double length) {
  const RangeGrid grid(length, kAngle);
  const double per_second = cloud.has_times() ? 1 / std::max(cell_duration(cloud), 1e-9) : 0.0;
  VoxelTable table;
  std::vector<CellSums> sums;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (keep[i] == 0) continue;
    const double time = cloud.has_times() ? double(cloud.times[i]) : 0.0;
    const int interval = std::clamp(int(time * per_second), 0, kIntervals - 1);
    const std::uint32_t number = table.insert(grid.key(cloud.points[i], interval - kIntervals / 2));
    if (number == sums.size()) sums.emplace_back();
    sums[number].add(cloud.points[i], time);
  }
  std::vector<PointCell> cells;
  cells.reserve(sums.size());
  for (const CellSums& s : sums) cells.push_back(s.cell());
  return cells;
}

}  // namespace tilth
