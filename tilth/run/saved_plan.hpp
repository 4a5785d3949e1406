// The floor plan of a saved map, as that of a run (docs/grid.md). A saved map has patches instead of points: each is
// filled with points as far as it reaches, seen from its place. O(patches).
#pragma once

#include <tilth/freespace/occupancy_grid.hpp>
#include <tilth/localization/place_map.hpp>

namespace tilth {

/// Throws Error as occupancy_of(points ...) does, and where patches cannot be read.
OccupancyGrid occupancy_of(const PlaceMap& map, const OccupancyOptions& options);

}  // namespace tilth
