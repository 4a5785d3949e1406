// Edge points held against lines and plane points against planes, each fitted to the five nearest points of the map
// (Zhang and Singh 2014; FLOAM; LIO-SAM). One look-up of five neighbours a point, O(log map), in parallel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/parallel.hpp>
#include <tilth/registration/residual.hpp>
#include <tilth/search/nearest_neighbors.hpp>

namespace tilth {

struct LinePlaneOptions {
  double max_distance = 1.0;
  double line_ratio = 3.0;
  double plane_distance = 0.2;
  bool planes_from_sensor = false;
  double weight_slope = 0.0;
  bool range_from_origin = false;
};

template <class V>
void visit(LinePlaneOptions& o, V&& v) {
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] to the farthest of five neighbours must be less");
  v("line_ratio", o.line_ratio, Bounds{1, 1e6},
    "[-] of the variance along a line to the next greatest one must be more", kAdvanced);
  v("plane_distance", o.plane_distance, Bounds{1e-6, 100}, "[m] of each neighbour from their plane, at most",
    kAdvanced);
  v("planes_from_sensor", o.planes_from_sensor,
    "[-] n . x = -1, which no plane through the origin fulfils, is fitted about the sensor; false: about the map's "
    "origin, as FLOAM, LeGO-LOAM and LIO-SAM do",
    kAdvanced);
  v("weight_slope", o.weight_slope, Bounds{0, 100},
    "[1/m] by which a pair's weight falls from 1 with its distance (of planes: over the root of the point's range in "
    "m); "
    "pairs of no more than 0.1 are left out (Zhang and Singh)",
    kAdvanced);
  v("range_from_origin", o.range_from_origin,
    "[-] as LeGO-LOAM: that range is the distance from the map's origin, not from the sensor", kAdvanced);
}

constexpr std::size_t kFitPoints = 5;
using FitPoints = std::array<Eigen::Vector3d, kFitPoints>;

struct FittedLine {
  Eigen::Vector3d point, direction;
};
struct FittedPlane {
  Eigen::Vector3d point, normal;
};

/// The line through the mean of `points`; none unless the variance along it is more than `ratio` times the next one.
std::optional<FittedLine> fit_line(const FitPoints& points, double ratio);

/// The plane n . (x - origin) = -1 of least squares, which cannot go through `origin`; none where one of `points` is
/// farther from it than `max_distance` [m].
std::optional<FittedPlane> fit_plane(const FitPoints& points, const Eigen::Vector3d& origin, double max_distance);

/// The pair of a source point and a fit, its residual scaled by its weight at T: 1 - `slope` [1/m] times the distance;
/// none where that is no more than 0.1.
std::optional<PointToLine> weighed(const Eigen::Vector3d& source, const FittedLine& line, const Pose& T, double slope);
std::optional<PointToPlane> weighed(const Eigen::Vector3d& source, const FittedPlane& plane, const Pose& T,
                                    double slope);

/// The slope for a plane point at `range` [m].
inline double plane_slope(double slope, double range) {
  return slope / std::sqrt(std::max(range, 1e-9));
}

/// Points that answer for their nearest neighbours.
template <class S>
concept SearchablePoints = NearestNeighbors<S> && requires(const S& s) {
  { s.points() } -> std::convertible_to<std::span<const Eigen::Vector3d>>;
};

/// The pairs of all `source` points, in their order. `pair_of(source point, its five neighbours)` makes one or none.
template <class Pair, SearchablePoints Target, class MakePair>
std::vector<Pair> associate_neighbors(std::span<const Eigen::Vector3d> source, const Pose& T, const Target& target,
                                      double max_distance, const MakePair& pair_of) {
  constexpr std::size_t kChunk = 128;
  std::vector<std::optional<Pair>> found(source.size());
  parallel_for(source.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> neighbors;
    const std::span<const Eigen::Vector3d> map_points = target.points();
    for (std::size_t i = begin; i < end; ++i) {
      target.knn(T * source[i], kFitPoints, neighbors);
      if (neighbors.size() < kFitPoints || neighbors.back().squared_distance >= max_distance * max_distance) continue;
      FitPoints points;
      for (std::size_t k = 0; k < kFitPoints; ++k) points[k] = map_points[neighbors[k].index];
      found[i] = pair_of(source[i], points);
    }
  });
  std::vector<Pair> pairs;
  pairs.reserve(source.size());
  for (const std::optional<Pair>& pair : found) {
    if (pair) pairs.push_back(*pair);
  }
  return pairs;
}

/// Pairs of edge points and lines at T.
template <SearchablePoints Target>
std::vector<PointToLine> associate_lines(std::span<const Eigen::Vector3d> edges, const Pose& T, const Target& target,
                                         const LinePlaneOptions& options) {
  return associate_neighbors<PointToLine>(
      edges, T, target, options.max_distance,
      [&](const Eigen::Vector3d& p, const FitPoints& neighbors) -> std::optional<PointToLine> {
        const std::optional<FittedLine> line = fit_line(neighbors, options.line_ratio);
        return line ? weighed(p, *line, T, options.weight_slope) : std::nullopt;
      });
}

/// Pairs of plane points and planes at T.
template <SearchablePoints Target>
std::vector<PointToPlane> associate_planes(std::span<const Eigen::Vector3d> planes, const Pose& T, const Target& target,
                                           const LinePlaneOptions& options) {
  const Eigen::Vector3d origin =
      options.planes_from_sensor ? Eigen::Vector3d(T.translation()) : Eigen::Vector3d(0, 0, 0);
  return associate_neighbors<PointToPlane>(
      planes, T, target, options.max_distance,
      [&](const Eigen::Vector3d& p, const FitPoints& neighbors) -> std::optional<PointToPlane> {
        const std::optional<FittedPlane> plane = fit_plane(neighbors, origin, options.plane_distance);
        if (!plane) return std::nullopt;
        const double range = options.range_from_origin ? (T * p).norm() : p.norm();
        return weighed(p, *plane, T, plane_slope(options.weight_slope, range));
      });
}

}  // namespace tilth
