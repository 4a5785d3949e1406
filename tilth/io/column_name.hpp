// What the names in the header of a table of poses mean: "tx", "p_RS_R_x [m]", "field.pose.pose.orientation.w", "nsec".
// O(characters).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tilth {

/// What a column of poses holds; the three of the position and the four of the quaternion stand in a row.
enum class PoseQuantity { stamp, nanoseconds, x, y, z, qx, qy, qz, qw };

constexpr std::size_t kPoseQuantities = 9;

/// As errors call them.
std::string_view name_of(PoseQuantity quantity);

struct ColumnMeaning {
  PoseQuantity quantity = PoseQuantity::stamp;  ///< nanoseconds: alone the whole stamp, beside seconds their fraction
  int certainty = 0;      ///< where two columns could be the same quantity, the more certain one is
  bool bare = false;      ///< one of x, y, z, w and nothing else
  bool numbered = false;  ///< q0, q1 ...: a quaternion that does not say which of its numbers is w
  std::string unit;       ///< "ns", "mm" ...; empty: not told
};

/// Nothing where the name is that of no part of a pose (velocities, biases, covariances ...).
std::optional<ColumnMeaning> meaning_of(std::string_view column_name);

}  // namespace tilth
