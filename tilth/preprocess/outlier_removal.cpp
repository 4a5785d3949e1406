#include <algorithm>
#include <cmath>
#include <limits>

#include <tilth/preprocess/adapted_threshold.hpp>
#include <tilth/preprocess/bounding_ball.hpp>
#include <tilth/preprocess/cell_support.hpp>
#include <tilth/preprocess/neighbor_distances.hpp>
#include <tilth/preprocess/outlier_removal.hpp>

namespace tilth {
namespace {

constexpr double kDelta = 1e-5;  // added to sigma so that it is never zero (paper, section 2.3)

Spread widened_spread(std::span<const float> means) {
  const Spread spread = spread_of(means);
  return {spread.mean, spread.deviation + kDelta};
}

/// The greatest float that is not above `value`.
float rounded_down(double value) {
  const auto nearest = float(value);
  return double(nearest) <= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::lowest());
}

void keep_below(std::span<const float> means, const OutlierOptions& options, std::span<std::uint8_t> keep) {
  const Spread spread = widened_spread(means);
  const float threshold = rounded_down(spread.mean + options.alpha * spread.deviation);
  for (std::size_t i = 0; i < means.size(); ++i) keep[i] = std::uint8_t(means[i] <= threshold);
}

}  // namespace

const std::vector<std::uint8_t>& OutlierFilter::keep_by_distance(const PointCloud& cloud,
                                                                 const NeighborTable& neighbors) {
  for (std::vector<float>* v : {&means_, &densities_}) v->resize(cloud.size());
  scale_.resize(options_.per_range ? cloud.size() : 0);
  inverse_ranges(std::span(cloud.points).first(scale_.size()), scale_);
  mean_distances(neighbors, scale_, means_);
  if (options_.method != OutlierMethod::plain) {
    const double average = std::max(spread_of(means_).mean, 1e-9);
    weighted_mean_distances(neighbors, scale_, float(1 / average), means_);
    if (options_.density != DensityTerm::none) {
      if (options_.ball == DensityBall::smallest)
        bounding_ball_densities(cloud, neighbors, scale_, densities_);
      else
        densities(neighbors, scale_, densities_);
      keep_below(means_, widened_spread(means_), densities_, options_, keep_);
      return keep_;
    }
  }
  keep_below(means_, options_, keep_);
  return keep_;
}

const std::vector<std::uint8_t>& OutlierFilter::keep(const PointCloud& cloud, const NeighborTable& neighbors) {
  if (is_by_support()) {
    if (auto supported = ring_support(cloud, options_.support)) return keep_ = std::move(*supported);
  }
  keep_.assign(cloud.size(), 1);
  const bool by_distance = options_.method != OutlierMethod::none && neighbors.size() > 0;
  return by_distance ? keep_by_distance(cloud, neighbors) : keep_;
}

const std::vector<std::uint8_t>& OutlierFilter::keep(const PointCloud& cloud, const RingLayout& rings) {
  if (is_by_support()) {
    if (auto supported = ring_support(rings, cloud.size(), options_.support)) return keep_ = std::move(*supported);
  }
  if (is_by_support() && !cloud.has_rings()) return keep_ = cell_support(cloud);
  keep_.assign(cloud.size(), 1);
  if (options_.method == OutlierMethod::none) return keep_;
  const NeighborTable& neighbors = neighbors_.compute(cloud, std::size_t(options_.k));
  return neighbors.size() > 0 ? keep_by_distance(cloud, neighbors) : keep_;
}

std::vector<std::uint8_t> keep_inliers(const PointCloud& cloud, const NeighborTable& neighbors,
                                       const OutlierOptions& options) {
  OutlierFilter filter(options);
  return filter.keep(cloud, neighbors);
}

}  // namespace tilth
