// How a map becomes a floor plan.
#pragma once

#include <tilth/core/options.hpp>

namespace tilth {

struct OccupancyOptions {
  double resolution = 0.05;  ///< [m] edge of a cell
  double low = 0.15;         ///< [m] above the ground: what is lower is ground
  double high = 1.8;         ///< [m] above the ground: what is higher can be driven under
};

template <class V>
void visit(OccupancyOptions& o, V&& v) {
  v("grid_resolution", o.resolution, Bounds{0.01, 10}, "[m] edge of a cell of the grid");
  v("grid_low", o.low, Bounds{0.01, 10}, "[m] above the local ground from which on a thing is an obstacle");
  v("grid_high", o.high, Bounds{0.02, 100}, "[m] above the local ground up to which a thing is an obstacle");
}

}  // namespace tilth
