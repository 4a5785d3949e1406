// Whether the scans are as large as the map they are looked for in: units that are mixed up, or ranges that are all too
// long, still fit a room's walls after a shift, at a place that is wrong.
#pragma once

#include <tilth/slam/submap.hpp>

namespace tilth {

/// The size of `query` as the map has it, over its own: 1 where both are metric, 1.25 where the query is a fifth too
/// small. Point to plane, with the pose at T_map_lidar and the logarithm of the size as the seventh unknown
/// (Umeyama 1991 for the group), coarse to fine under a Geman-McClure kernel. 1 where too little matches, or where no
/// surface tells.
double scale_in_map(const SurfacePatches& query, const Submap& map, const Pose& T_map_lidar,
                    const SubmapOptions& options);

}  // namespace tilth
