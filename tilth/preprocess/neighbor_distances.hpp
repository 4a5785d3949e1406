// Per-point statistics of a table of neighbours, with as many points at once as the processor has lanes (Highway).
// Nothing is allocated. O(n k).
#pragma once

#include <span>

#include <Eigen/Core>

#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

/// The most neighbours of a point that these functions take; more are an Error.
inline constexpr std::size_t kMostNeighbors = 255;

/// 1 / range of each point; a millimetre from the sensor at least. As many `scale`.
void inverse_ranges(std::span<const Eigen::Vector3d> points, std::span<float> scale);

/// For each point the mean of its distances times scale_i. `scale` is empty (all 1) or has one a point, as has `means`.
void mean_distances(const NeighborTable& neighbors, std::span<const float> scale, std::span<float> means);

/// The same with each scaled distance d_it weighted by exp(-decay * d_it).
void weighted_mean_distances(const NeighborTable& neighbors, std::span<const float> scale, float decay,
                             std::span<float> means);

}  // namespace tilth
