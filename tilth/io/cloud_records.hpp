// Clouds as records, and records without gaps: what the writers of point files take. O(n).
#pragma once

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/point_records.hpp>

namespace tilth {

/// x y z [m] as float32, then what the cloud has of: intensity float32, ring uint16, time float32 [s].
PointRecords to_records(const PointCloud& cloud);

/// The same fields and values, one field after the other without padding, in little-endian order. Throws Error where a
/// field reaches beyond its record or `bytes` is shorter than the records.
PointRecords packed(const PointRecords& records);

}  // namespace tilth
