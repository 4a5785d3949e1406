// Records with some points left out, or with other coordinates. O(bytes).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include <tilth/core/point_records.hpp>
#include <tilth/sensor/point_fields.hpp>

namespace tilth {

/// The records whose entry in `keep`, one a record, is not zero.
PointRecords kept_records(const PointRecords& records, std::span<const std::uint8_t> keep);

/// At most `count` of the records, evenly spread over all.
PointRecords sampled_records(const PointRecords& records, std::size_t count);

/// x y z of every record, whatever they are.
std::vector<Eigen::Vector3d> coordinates_of(const PointRecords& records, const PointFieldRoles& roles);

/// The points of at most `count` of the records, evenly spread, that are finite and not (0, 0, 0), without
/// strays that lie farther off than any sensor sees. x, y and z must be there.
std::vector<Eigen::Vector3d> measured_sample(const PointRecords& records, std::size_t count);

/// `points`, one a record, in place of the coordinates: x y z as float64 in front of what the records hold beside.
PointRecords with_coordinates(const PointRecords& records, const PointFieldRoles& roles,
                              std::span<const Eigen::Vector3d> points);

/// Without the field of that name; its bytes stay where they are.
void remove_field(PointRecords& records, std::string_view name);

}  // namespace tilth
