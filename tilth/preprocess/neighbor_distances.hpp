// Per-point statistics of a table of neighbours, with as many points at once as the processor has lanes (Highway).
#pragma once

#include <span>
#include <vector>

#include <tilth/search/scan_neighbors.hpp>

namespace tilth {

/// The mean over all neighbours of all points of distance_it * scale_i.
double mean_distance(const NeighborTable& neighbors, std::span<const float> scale);

/// For each point the mean of its scaled distances d_it, each weighted by exp(-decay * d_it); decay = 0 is the plain
/// mean.
std::vector<float> mean_distances(const NeighborTable& neighbors, std::span<const float> scale, float decay);

}  // namespace tilth
