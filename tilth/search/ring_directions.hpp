// Directions of the points of a ring, without trigonometry, a vector at a time.
#pragma once

#include <cstdint>

#include <tilth/search/ring_layout.hpp>

namespace tilth {

/// What the directions of a ring say about it.
struct RingDirections {
  float lowest_slope = 0.0f, highest_slope = 0.0f;  ///< height over horizontal range; points at the origin have none
  std::uint32_t on_axis = 0;                        ///< points without azimuth
  std::uint32_t descents = 0;                       ///< points of less azimuth than the one before
  std::uint32_t last_descent = 0;                   ///< the last of them, counted from the ring's begin
};

/// Fills ux, uy and azimuth (in [0, 4)) of a ring from its x and y.
RingDirections measure_directions(RingLayout& layout, const Ring& ring);

}  // namespace tilth
