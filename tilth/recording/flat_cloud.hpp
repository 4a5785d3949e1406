// Clouds without a third dimension: of 2D laser scanners, or flattened.
#pragma once

#include <span>

#include <tilth/core/point_records.hpp>

namespace tilth {

/// Throws Error where the points of every scan lie in one plane that is level or goes through (0, 0, 0). The roles of
/// the fields must be readable.
void refuse_flat_clouds(std::span<const PointRecords> scans);

}  // namespace tilth
