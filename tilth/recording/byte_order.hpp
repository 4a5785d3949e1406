// Which byte order the numbers of a cloud are in, whatever its message says (is_bigendian). O(1): a sample is enough.
#pragma once

#include <bit>

#include <tilth/core/point_records.hpp>
#include <tilth/sensor/point_fields.hpp>

namespace tilth {

/// The order stated, unless few of the coordinates are such as a sensor measures in it, and nearly all in the other.
std::endian byte_order_of(const PointRecords& records, const PointFieldRoles& roles);

}  // namespace tilth
