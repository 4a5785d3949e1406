// A scan whose rings are not known as patches of surface: the points of each cell of a grid, with the shape that the
// cells around give them. Cells of one beam lie on a line, and a line that travels with the sensor says nothing true
// about the surface: a neighbourhood grows until it is wide. O(cells log cells).
#pragma once

#include <tilth/features/surface_patches.hpp>

namespace tilth {

/// The patches of `cloud`, in the order of their first points. Points whose entry in `keep`, one a point, is zero are
/// passed over.
SurfacePatches neighborhood_patches(const PointCloud& cloud, std::span<const std::uint8_t> keep,
                                    const PatchOptions& options);

}  // namespace tilth
