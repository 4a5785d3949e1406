// Outlier removal for spinning LiDARs: a point stays where the beams beside it tell of the same surface. Its spacing to
// them follows from range and beam angles, which one threshold for all ranges (SOR) cannot do. O(n), no neighbour
// search; docs/outlier_removal.md has the formulas and what they reach.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/search/ring_layout.hpp>

namespace tilth {

struct RingSupportOptions {
  double noise = 0.02;
  double slope = 2.0;
};

template <class V>
void visit(RingSupportOptions& o, V&& v) {
  v("noise", o.noise, Bounds{1e-6, 10}, "[m] standard deviation of a range; three of them are allowed for");
  v("slope", o.slope, Bounds{0, 100},
    "[-] greatest step of the range from beam to beam along a ring, over the arc between them; steeper surfaces must "
    "go on evenly",
    kAdvanced);
}

/// For each point of `cloud` 1 where a neighbour on its ring, the line through two of them, or a neighbour on the ring
/// above or below has its distance from the axis, else 0. Nothing where the rings give no order to go along: there are
/// none, or less than half of the points find support.
std::optional<std::vector<std::uint8_t>> ring_support(const PointCloud& cloud, const RingSupportOptions& options);

/// The same of the `points` points of a cloud that is laid out already.
std::optional<std::vector<std::uint8_t>> ring_support(const RingLayout& rings, std::size_t points,
                                                      const RingSupportOptions& options);

}  // namespace tilth
