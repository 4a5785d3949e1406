#include <algorithm>
#include <cmath>
#include <numeric>

#include <tilth/features/row_scan.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMargin = 5;  // neighbours on either side that a point's curvature is made of
constexpr std::size_t kSectors = 6;
constexpr int kMostColumnGap = 10;
constexpr float kStep = 0.3f;    // [m] between a surface and what it may hide
constexpr float kRatio = 0.02f;  // of the range, between a point and both neighbours

int column_gap(std::span<const std::uint16_t> columns, std::size_t i, std::size_t j) {
  return std::abs(int(columns[i]) - int(columns[j]));
}

}  // namespace

RowScan row_scan(const PointCloud& cloud, const RangeImage& image, std::span<const std::uint8_t> keep) {
  RowScan scan;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint16_t> rows;
  for (int row = 0; row < image.rows; ++row) {
    scan.row_begin.push_back(std::uint32_t(indices.size()));
    for (int column = 0; column < image.columns; ++column) {
      const std::size_t cell = image.cell(row, column);
      if (!keep[cell] || !image.filled(cell)) continue;
      indices.push_back(image.points[cell]);
      scan.ranges.push_back(image.ranges[cell]);
      scan.columns.push_back(std::uint16_t(column));
      rows.push_back(std::uint16_t(row));
    }
  }
  scan.row_begin.push_back(std::uint32_t(indices.size()));
  scan.cloud = select(cloud, indices);
  scan.cloud.rings = rows;
  return scan;
}

std::vector<double> range_curvature(std::span<const float> ranges) {
  std::vector<double> curvature(ranges.size(), 0.0);
  for (std::size_t i = kMargin; i + kMargin < ranges.size(); ++i) {
    double sum = -11 * double(ranges[i]);
    for (std::size_t j = i - kMargin; j <= i + kMargin; ++j) sum += double(ranges[j]);
    curvature[i] = sum * sum;
  }
  return curvature;
}

std::vector<std::uint8_t> unusable_points(const RowScan& scan) {
  const std::span<const float> ranges = scan.ranges;
  std::vector<std::uint8_t> marks(ranges.size(), 0);
  const auto mark = [&](std::size_t begin, std::size_t end) {
    std::fill(marks.begin() + std::ptrdiff_t(begin), marks.begin() + std::ptrdiff_t(end), std::uint8_t{1});
  };
  for (std::size_t i = kMargin; i + kMargin + 1 < ranges.size(); ++i) {
    const bool near_columns = column_gap(scan.columns, i, i + 1) < kMostColumnGap;
    if (near_columns && ranges[i] - ranges[i + 1] > kStep) mark(i - kMargin, i + 1);
    if (near_columns && ranges[i + 1] - ranges[i] > kStep) mark(i + 1, i + kMargin + 2);
    const float most = kRatio * ranges[i];
    if (std::abs(ranges[i - 1] - ranges[i]) > most && std::abs(ranges[i + 1] - ranges[i]) > most) marks[i] = 1;
  }
  return marks;
}

void suppress_around(std::size_t point, std::span<const std::uint16_t> columns, std::vector<std::uint8_t>& marks) {
  marks[point] = 1;
  for (std::size_t i = point; i < point + kMargin && i + 1 < columns.size(); ++i) {
    if (column_gap(columns, i, i + 1) > kMostColumnGap) break;
    marks[i + 1] = 1;
  }
  for (std::size_t i = point; i + kMargin > point && i > 0; --i) {
    if (column_gap(columns, i, i - 1) > kMostColumnGap) break;
    marks[i - 1] = 1;
  }
}

std::vector<Sector> sectors_of_row(const RowScan& scan, std::size_t row) {
  std::vector<Sector> sectors;
  const std::size_t row_begin = scan.row_begin[row], row_end = scan.row_begin[row + 1];
  if (row_end - row_begin <= 2 * kMargin) return sectors;
  const std::size_t first = row_begin + kMargin, last = row_end - kMargin - 1;
  const auto bound = [&](std::size_t s) { return (first * (kSectors - s) + last * s) / kSectors; };
  for (std::size_t s = 0; s < kSectors; ++s) {
    if (bound(s) + 1 < bound(s + 1)) sectors.push_back({bound(s), bound(s + 1)});
  }
  return sectors;
}

std::vector<std::uint32_t> by_curvature(const Sector& sector, std::span<const double> curvature, bool all_but_last) {
  std::vector<std::uint32_t> order(sector.end - sector.begin);
  std::iota(order.begin(), order.end(), std::uint32_t(sector.begin));
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(curvature[a], a) < std::pair(curvature[b], b);
  };
  std::sort(order.begin(), order.end() - (all_but_last && !order.empty()), less);
  return order;
}

}  // namespace tilth
