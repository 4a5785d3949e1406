// A scan row by row as LeGO-LOAM (Shan and Englot 2018) and LIO-SAM choose their features from it: curvature of the
// ranges along a row, and the points that no feature may be made of (Zhang and Singh 2014, section V-A). O(points).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tilth/core/point_cloud.hpp>
#include <tilth/features/range_image.hpp>

namespace tilth {

struct RowScan {
  PointCloud cloud;                      ///< row by row, columns ascending; `rings` are the rows
  std::vector<float> ranges;             ///< [m] of each point
  std::vector<std::uint16_t> columns;    ///< of each point
  std::vector<std::uint32_t> row_begin;  ///< rows + 1: where each row begins, and the end

  std::size_t rows() const { return row_begin.size() - 1; }
};

/// The points of the cells of `image` whose entry in `keep`, one a cell, is not zero.
RowScan row_scan(const PointCloud& cloud, const RangeImage& image, std::span<const std::uint8_t> keep);

/// (sum of the ranges of the five points before and after - 10 r)^2 [m^2] of each point; 0 for the first and last five.
std::vector<double> range_curvature(std::span<const float> ranges);

/// 1 for a point that a nearer surface may hide in the next scan (a step of more than 0.3 m between neighbours hides
/// the six points on its far side), or that stands out from both neighbours by more than 2 % of its range.
std::vector<std::uint8_t> unusable_points(const RowScan& scan);

/// Marks `point` and its five neighbours on either side, up to a gap of more than ten columns.
void suppress_around(std::size_t point, std::span<const std::uint16_t> columns, std::vector<std::uint8_t>& marks);

/// One of the six parts of a row, its points from `begin` up to `end`; the first and last five of the row are in none.
struct Sector {
  std::size_t begin = 0, end = 0;
};

/// The six sectors of a row, those of less than two points left out; the last point before the margin is in none.
std::vector<Sector> sectors_of_row(const RowScan& scan, std::size_t row);

/// The points of a sector from the least to the most curved. `all_but_last` as the originals: the last one stays last,
/// whatever its curvature.
std::vector<std::uint32_t> by_curvature(const Sector& sector, std::span<const double> curvature, bool all_but_last);

}  // namespace tilth
