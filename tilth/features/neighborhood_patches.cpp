#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>

#include <tilth/core/symmetric_eigen.hpp>
#include <tilth/features/neighborhood_patches.hpp>
#include <tilth/features/plane_misfit.hpp>
#include <tilth/features/point_cells.hpp>
#include <tilth/search/kdtree.hpp>

namespace tilth {
namespace {

constexpr std::array<std::size_t, 2> kStages{6, 12};     // cells of a neighbourhood as it grows
constexpr double kLeastReach = 0.8, kReachRatio = 0.15;  // [m], and of the range: cells of one neighbourhood
constexpr double kLeastWidth = 4e-4;                     // [m^2] variance across a line
constexpr double kWidthRatio = 0.03;                     // of the variance along it
constexpr std::size_t kLineCells = 3;                    // that tell where a line goes
constexpr double kBesideLength = 2.5;                    // of a cell: the edge of those beside a line
constexpr std::size_t kBesideCells = 20;                 // looked at
constexpr double kBesideReach = 0.5;                     // of the range
constexpr double kBesideLeast = 0.1;                     // [m] from the line
constexpr double kBesideSlant = 1.0;                     // along the line, over the distance from it

std::vector<Eigen::Vector3d> means(std::span<const PointCell> cells) {
  std::vector<Eigen::Vector3d> means;
  means.reserve(cells.size());
  for (const PointCell& cell : cells) means.push_back(cell.moments.mean);
  return means;
}

/// Cells of one size, and which are near one another in space and time.
class CellIndex {
 public:
  CellIndex(std::vector<PointCell> cells, double longest)
      : cells_(without_strays(std::move(cells))), longest_(longest), tree_(means(cells_)) {}

  std::span<const PointCell> cells() const { return cells_; }

  /// The `most` cells nearest to `cell`, nearest first, none farther than `reach` [m] or from another time.
  void near(const PointCell& cell, std::size_t most, double reach, std::vector<const PointCell*>& near) {
    tree_.knn(cell.moments.mean, most, neighbors_);
    near.clear();
    for (const Neighbor& neighbor : neighbors_) {
      if (neighbor.squared_distance > reach * reach) break;
      const PointCell& other = cells_[neighbor.index];
      if (std::abs(double(other.time - cell.time)) <= longest_) near.push_back(&other);
    }
  }

 private:
  static std::vector<PointCell> without_strays(std::vector<PointCell> cells) {
    std::erase_if(cells, [](const PointCell& cell) { return cell.moments.count < 2; });
    return cells;
  }

  std::vector<PointCell> cells_;
  double longest_;  // [s] between cells that are near
  KdTree tree_;
  std::vector<Neighbor> neighbors_;
};

/// A shape that a patch may have.
struct Shape {
  Moments joined;
  Symmetric3d covariance = joined.covariance();
  Eigen::Vector3d variances = eigenvalues(covariance);
  Eigen::Vector3d normal = smallest_eigenvector(covariance, variances[0]);

  bool wide() const { return variances[1] > kLeastWidth && variances[1] > kWidthRatio * variances[2]; }
};

class CellFitter {
 public:
  CellFitter(const PointCloud& cloud, std::span<const std::uint8_t> keep, const PatchOptions& options)
      : options_(options),
        fine_(point_cells(cloud, keep, options.segments.length), kLongest * cell_duration(cloud)),
        coarse_(point_cells(cloud, keep, kBesideLength * options.segments.length), kLongest * cell_duration(cloud)) {}

  SurfacePatches patches() {
    SurfacePatches patches;
    patches.reserve(fine_.cells().size());
    for (const PointCell& cell : fine_.cells()) {
      if (cell.moments.count < double(options_.segments.min_points)) continue;
      if (const std::optional<SurfacePatch> patch = patch_of(cell)) patches.push_back(*patch);
    }
    return patches;
  }

 private:
  static constexpr double kLongest = 1.5;  // intervals of time

  std::optional<SurfacePatch> patch_of(const PointCell& cell) {
    const double range = cell.moments.mean.norm();
    fine_.near(cell, kStages.back(), std::max(kLeastReach, kReachRatio * range), near_);
    std::optional<Shape> last;
    for (const std::size_t stage : kStages) {
      const std::size_t count = std::min(stage, near_.size());
      if (count < kLineCells) break;
      const Shape shape{joined(count)};
      if (shape.wide() && is_plane(shape, count)) return made(cell, shape, true);
      last = shape;
      if (shape.wide()) break;
    }
    if (!last) return std::nullopt;
    if (const std::optional<Shape> plane = plane_across(cell, range)) return made(cell, *plane, true);
    return last->wide() ? std::optional(made(cell, *last, false)) : std::nullopt;
  }

  Moments joined(std::size_t count) const {
    Moments joined;
    for (std::size_t i = 0; i < count; ++i) joined.add(near_[i]->moments);
    return joined;
  }

  bool is_thin(const Shape& shape) const {
    return is_flat(shape.variances, options_.max_thickness * options_.max_thickness);
  }

  /// Whether the cells miss the plane by no more than their points scatter about it.
  bool is_plane(const Shape& shape, std::size_t count) const {
    if (!is_thin(shape)) return false;
    double within = 0;
    for (std::size_t i = 0; i < count; ++i) within += near_[i]->moments.scatter.along(shape.normal);
    const double points = shape.joined.count, freedom = double(count) - 3;
    const double between = std::max(0.0, shape.joined.scatter.along(shape.normal) - within);
    const double variance = within / std::max(1.0, points - double(count) - 3);
    return between <= variance * (freedom + options_.max_misfit * std::sqrt(2 * freedom)) +
                          points * options_.roughness * options_.roughness;
  }

  /// The plane of a line of cells and the nearest cells on either side of it.
  std::optional<Shape> plane_across(const PointCell& cell, double range) {
    const Moments line = joined(kLineCells);
    const Eigen::Vector3d direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
                                          .computeDirect(line.covariance().matrix())
                                          .eigenvectors()
                                          .col(2);
    coarse_.near(cell, kBesideCells, kBesideReach * range, near_);
    const PointCell* one = nullptr;
    Eigen::Vector3d to_one;
    for (const PointCell* other : near_) {
      const Eigen::Vector3d offset = other->moments.mean - cell.moments.mean;
      const double lengthwise = offset.dot(direction);
      const Eigen::Vector3d across = offset - lengthwise * direction;
      if (across.norm() < kBesideLeast || std::abs(lengthwise) > kBesideSlant * across.norm()) continue;
      if (one == nullptr) one = other, to_one = across;
      if (across.dot(to_one) < 0) return plane_of({&line, &one->moments, &other->moments});
    }
    return std::nullopt;
  }

  std::optional<Shape> plane_of(const RunSet& three) const {
    Moments all = *three[0];
    all.add(*three[1]);
    all.add(*three[2]);
    const Shape shape{all};
    const bool plane = shape.wide() && is_thin(shape) &&
                       is_one_plane(plane_misfit(three, shape.normal), options_.max_misfit, options_.roughness);
    return plane ? std::optional(shape) : std::nullopt;
  }

  static SurfacePatch made(const PointCell& cell, const Shape& shape, bool flat) {
    return {.mean = cell.moments.mean,
            .covariance = shape.covariance.matrix(),
            .normal = shape.normal.dot(cell.moments.mean) > 0 ? Eigen::Vector3d(-shape.normal) : shape.normal,
            .time = cell.time,
            .thickness = float(std::max(0.0, shape.variances[0])),
            .points = std::uint16_t(std::min(cell.moments.count, 65535.0)),
            .flat = flat};
  }

  const PatchOptions& options_;
  CellIndex fine_, coarse_;
  std::vector<const PointCell*> near_;
};

}  // namespace

SurfacePatches neighborhood_patches(const PointCloud& cloud, std::span<const std::uint8_t> keep,
                                    const PatchOptions& options) {
  return CellFitter(cloud, keep, options).patches();
}

}  // namespace tilth
