#include <cmath>
#include <numbers>

#include <tilth/features/range_image.hpp>

namespace tilth {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// -1 where the point belongs to no row.
int row_of(const PointCloud& cloud, std::size_t i, const RangeImageOptions& options) {
  int row = 0;
  if (cloud.has_rings()) {
    row = cloud.rings[i];
  } else {
    const Eigen::Vector3d& p = cloud.points[i];
    const double elevation = kDegrees * std::atan2(p.z(), std::hypot(p.x(), p.y()));
    row = int(std::floor((elevation - options.lowest_elevation) / options.row_step));
  }
  return row >= 0 && row < options.rows ? row : -1;
}

}  // namespace

int column_of(const Eigen::Vector3d& point, int columns) {
  const double step = 360.0 / columns;
  const double from_left = kDegrees * std::atan2(point.x(), point.y()) - 90;  // 0 straight ahead, in (-270, 90]
  const int column = int(-std::round(from_left / step)) + columns / 2;
  return column >= columns ? column - columns : column;
}

RangeImage project(const PointCloud& cloud, const RangeImageOptions& options) {
  const std::size_t cells = std::size_t(options.rows) * std::size_t(options.columns);
  RangeImage image{options.rows, options.columns, std::vector<float>(cells),
                   std::vector<std::uint32_t>(cells, RangeImage::kNone)};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double range = cloud.points[i].norm();
    const int row = row_of(cloud, i, options);
    if (!std::isfinite(range) || range < options.min_range || row < 0) continue;
    const std::size_t cell = image.cell(row, column_of(cloud.points[i], options.columns));
    if (options.cell_keeps == CellKeeps::first_return && image.filled(cell)) continue;
    image.ranges[cell] = float(range);
    image.points[cell] = std::uint32_t(i);
  }
  return image;
}

}  // namespace tilth
