// What the fields of a point record mean, told by their names as drivers write them (docs/formats/time_and_ring.md).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <tilth/core/point_records.hpp>

namespace tilth {

struct PointFieldRoles {
  PointField x, y, z;
  std::optional<PointField> intensity, ring, time;
};

/// Roles by name, upper or lower case, with or without CloudCompare's "scalar_". Throws Error where x, y or z is
/// missing.
PointFieldRoles roles_of(const PointRecords& records);

std::string name_of(FieldType type);  ///< "u32"

/// The points of records that have a return, in their order, and the raw values of their fields.
struct MeasuredPoints {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<float> intensities;       ///< empty without such a field, as are the next two
  std::vector<double> ring_values;
  std::vector<double> time_values;
  std::size_t not_finite = 0;  ///< records left out: a coordinate is NaN or infinite
  std::size_t no_return = 0;   ///< records left out: (0, 0, 0)
};

/// Throws Error where no record has a return. O(n).
MeasuredPoints measured_points(const PointRecords& records, const PointFieldRoles& roles);

}  // namespace tilth
