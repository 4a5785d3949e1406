#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/features/ground.hpp>

namespace tilth {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// [deg] of the line from `low` to `high` above the horizontal plane.
double slope(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const Eigen::Vector3d d = high - low;
  return std::atan2(d.z(), std::hypot(d.x(), d.y())) / kRadians;
}

// The angle criterion for two beams that are `step` [rad] apart.
struct SurfaceTest {
  explicit SurfaceTest(double step) : sin_step(std::sin(step)), cos_step(std::cos(step)) {}
  bool operator()(double a, double b, double tan_min_angle) const {
    const double far = std::max(a, b), near = std::min(a, b), along = far - near * cos_step;
    return near * sin_step > tan_min_angle * along;
  }
  double sin_step, cos_step;
};

// Grows clusters cell by cell, breadth first.
class ClusterGrower {
 public:
  ClusterGrower(const RangeImage& image, double row_step, const ClusterOptions& options)
      : image_(image),
        options_(options),
        same_row_(2 * std::numbers::pi / image.columns),
        same_column_(row_step * kRadians),
        tan_min_angle_(std::tan(options.min_angle * kRadians)) {}

  // Labels the cluster that `seed` belongs to.
  void grow(std::size_t seed, std::vector<CellLabel>& labels, std::vector<std::uint8_t>& waiting) {
    cells_.assign(1, seed);
    std::vector<std::uint8_t> rows(std::size_t(image_.rows));
    waiting[seed] = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (const std::size_t next : neighbors(cells_[i])) {
        if (!waiting[next] || !joins(cells_[i], next)) continue;
        waiting[next] = 0;
        rows[next / std::size_t(image_.columns)] = 1;
        cells_.push_back(next);
      }
    }
    const CellLabel label = is_valid(std::count(rows.begin(), rows.end(), 1)) ? CellLabel::cluster : CellLabel::noise;
    for (const std::size_t cell : cells_) labels[cell] = label;
  }

 private:
  // Above the last row and below the first one a cell is its own neighbour.
  std::array<std::size_t, 4> neighbors(std::size_t cell) const {
    const std::size_t columns = std::size_t(image_.columns), column = cell % columns, row_begin = cell - column;
    const bool is_first_row = cell < columns, is_last_row = cell + columns >= image_.ranges.size();
    return {is_first_row ? cell : cell - columns, row_begin + (column + 1) % columns,
            row_begin + (column + columns - 1) % columns, is_last_row ? cell : cell + columns};
  }

  bool joins(std::size_t a, std::size_t b) const {
    const std::size_t columns = std::size_t(image_.columns);
    const SurfaceTest& test = a / columns == b / columns ? same_row_ : same_column_;
    return test(double(image_.ranges[a]), double(image_.ranges[b]), tan_min_angle_);
  }

  bool is_valid(std::ptrdiff_t rows) const {
    const int cells = int(cells_.size());
    return cells >= options_.min_cells || (cells >= options_.min_cells_on_rows && rows >= options_.min_rows);
  }

  const RangeImage& image_;
  const ClusterOptions& options_;
  SurfaceTest same_row_, same_column_;
  double tan_min_angle_;
  std::vector<std::size_t> cells_;
};

}  // namespace

std::vector<std::uint8_t> mark_ground(const PointCloud& cloud, const RangeImage& image, const GroundOptions& options) {
  std::vector<std::uint8_t> ground(image.points.size(), 0);
  const int pairs = std::min(options.rows, image.rows - 1);
  for (int row = 0; row < pairs; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const std::size_t low = image.cell(row, column), high = image.cell(row + 1, column);
      const bool complete = image.filled(low) && image.filled(high);
      if (!complete) ground[low] = 0;
      if (!complete) continue;
      const double angle = slope(cloud.points[image.points[low]], cloud.points[image.points[high]]);
      if (std::abs(angle - options.mount_angle) <= options.max_slope) ground[low] = ground[high] = 1;
    }
  }
  return ground;
}

std::vector<CellLabel> cluster(const RangeImage& image, std::span<const std::uint8_t> ground, double row_step,
                               const ClusterOptions& options) {
  std::vector<CellLabel> labels(image.points.size(), CellLabel::empty);
  std::vector<std::uint8_t> waiting(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (ground[i]) labels[i] = CellLabel::ground;
    waiting[i] = image.filled(i) && !ground[i];
  }
  ClusterGrower grower(image, row_step, options);
  for (std::size_t seed = 0; seed < labels.size(); ++seed) {
    if (waiting[seed]) grower.grow(seed, labels, waiting);
  }
  return labels;
}

}  // namespace tilth
