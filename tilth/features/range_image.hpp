// The range image of LeGO-LOAM (Shan and Englot 2018) and LIO-SAM: a spinning LiDAR's scan as a picture, a row a beam
// and a column a step of azimuth. Straight ahead (+x) is the middle column, columns grow anticlockwise, the seam is
// behind.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>

namespace tilth {

enum class CellKeeps { last_return, first_return };
inline std::span<const std::string_view> names_of(CellKeeps) {
  static constexpr std::array<std::string_view, 2> names{"last_return", "first_return"};
  return names;
}

struct RangeImageOptions {
  int rows = 16;
  int columns = 1800;
  double lowest_elevation = -15.1;
  double row_step = 2.0;
  double min_range = 1.0;
  CellKeeps cell_keeps = CellKeeps::last_return;
};

template <class V>
void visit(RangeImageOptions& o, V&& v) {
  v("rows", o.rows, Bounds{1, 1024}, "[-] beams of the sensor");
  v("columns", o.columns, Bounds{16, 65535}, "[-] of the image, over a whole turn");
  v("lowest_elevation", o.lowest_elevation, Bounds{-90, 90},
    "[deg] of the lowest beam, less a little; used where points have no rings");
  v("row_step", o.row_step, Bounds{0.01, 90}, "[deg] between two beams");
  v("min_range", o.min_range, Bounds{0, 1e4}, "[m] nearer points are dropped");
  v("cell_keeps", o.cell_keeps, "[-] which point of those that share a cell");
}

struct RangeImage {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  int rows = 0, columns = 0;
  std::vector<float> ranges;          ///< [m] row by row, the lowest beam first; 0 in an empty cell
  std::vector<std::uint32_t> points;  ///< number of the point in the cloud; kNone in an empty cell

  std::size_t cell(int row, int column) const { return std::size_t(row) * std::size_t(columns) + std::size_t(column); }
  bool filled(std::size_t cell) const { return points[cell] != kNone; }
};

/// The column of a point: the azimuth rounded to steps of a whole turn over `columns`.
int column_of(const Eigen::Vector3d& point, int columns);

/// The image of the finite points of `cloud` that are not nearer than min_range; rings beyond the last row are dropped.
/// Rows are rings, or, of a cloud without rings, come from elevations. O(points + cells).
RangeImage project(const PointCloud& cloud, const RangeImageOptions& options);

}  // namespace tilth
