// Clouds in the coordinates of a map (UTM): whether they are, and where the sensor is in them. O(n).
#pragma once

#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>

#include <tilth/core/point_records.hpp>
#include <tilth/recording/field_values.hpp>

namespace tilth {

struct MapCoordinates {
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< in the unit of the clouds; to a metre where no rings tell it
  std::string sentence;
};

/// Nothing where coordinates are about the sensor. `rings` checks the rings of the clouds, whose coordinates must be
/// readable. Throws Error where float32 cannot tell points apart so far away, and where the sensor moves in the
/// coordinates: such scans are registered already.
std::optional<MapCoordinates> map_coordinates(std::span<const PointRecords> first, const RingValues& rings);

}  // namespace tilth
