#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tilth/preprocess/neighbor_distances.hpp>
#include <tilth/preprocess/outlier_removal.hpp>

namespace tilth {
namespace {

constexpr double kDelta = 1e-5;  // added to sigma so that it is never zero (paper, section 2.3)

struct Spread {
  double mean, deviation;
};

Spread spread_of(std::span<const float> values) {
  const double n = double(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const float v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / std::max(1.0, n - 1)) + kDelta};
}

// What distances are multiplied by: 1, or 1 / range.
std::vector<float> scale_of(const PointCloud& cloud, bool per_range) {
  std::vector<float> scale(cloud.size(), 1.0f);
  if (!per_range) return scale;
  for (std::size_t i = 0; i < cloud.size(); ++i) scale[i] = 1.0f / float(std::max(cloud.points[i].norm(), 1e-3));
  return scale;
}

// rho_i = k / volume of the ball that holds the k neighbours.
std::vector<float> densities(const NeighborTable& neighbors, std::span<const float> scale) {
  std::vector<float> rho(neighbors.size());
  const float k_over_unit_ball = float(double(neighbors.k) / (4.0 / 3.0 * std::numbers::pi));
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const float radius = std::max(std::sqrt(neighbors.distances(i).back()) * scale[i], 1e-6f);
    rho[i] = k_over_unit_ball / (radius * radius * radius);
  }
  return rho;
}

double density_term(double x, const OutlierOptions& options) {
  const double g = options.density == DensityTerm::inverse ? 1 / x : 1 - x;
  return std::clamp(g, options.density_min, options.density_max);
}

std::vector<std::uint8_t> keep_below(std::span<const float> means, std::span<const float> rho,
                                     const OutlierOptions& options) {
  const Spread spread = spread_of(means);
  const double rho_mean = rho.empty() ? 1.0 : spread_of(rho).mean;
  std::vector<std::uint8_t> keep(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double g = rho.empty() ? 0.0 : density_term(rho[i] / rho_mean, options);
    keep[i] = means[i] <= spread.mean + options.alpha * spread.deviation * (1 + g);
  }
  return keep;
}

std::vector<std::uint8_t> keep_by_distance(const PointCloud& cloud, const NeighborTable& neighbors,
                                           const OutlierOptions& options) {
  const std::vector<float> scale = scale_of(cloud, options.per_range);
  if (options.method == OutlierMethod::plain) return keep_below(mean_distances(neighbors, scale, 0), {}, options);
  const double average = std::max(mean_distance(neighbors, scale), 1e-9);
  const std::vector<float> means = mean_distances(neighbors, scale, float(1 / average));
  if (options.density == DensityTerm::none) return keep_below(means, {}, options);
  return keep_below(means, densities(neighbors, scale), options);
}

// `support() -> optional<keep>` and `table() -> NeighborTable` are asked for where the method needs them.
template <class Support, class Table>
std::vector<std::uint8_t> keep_by_method(const PointCloud& cloud, const Support& support, const Table& table,
                                         const OutlierOptions& options) {
  const std::vector<std::uint8_t> all(cloud.size(), 1);
  if (options.method == OutlierMethod::none) return all;
  if (options.method == OutlierMethod::support) {
    if (auto keep = support()) return std::move(*keep);
  }
  const NeighborTable& neighbors = table();
  return neighbors.size() == 0 ? all : keep_by_distance(cloud, neighbors, options);
}

}  // namespace

std::vector<std::uint8_t> keep_inliers(const PointCloud& cloud, const NeighborTable& neighbors,
                                       const OutlierOptions& options) {
  return keep_by_method(
      cloud, [&] { return ring_support(cloud, options.support); }, [&]() -> const NeighborTable& { return neighbors; },
      options);
}

std::vector<std::uint8_t> keep_inliers(const PointCloud& cloud, const RingLayout& rings, ScanNeighbors& neighbors,
                                       const OutlierOptions& options) {
  return keep_by_method(
      cloud, [&] { return ring_support(rings, cloud.size(), options.support); },
      [&]() -> const NeighborTable& { return neighbors.compute(cloud, std::size_t(options.k)); }, options);
}

}  // namespace tilth
