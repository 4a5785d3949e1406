// A table of poses: a row a pose, columns by the names in its header or, without one, as TUM has them. O(characters).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <tilth/core/trajectory.hpp>
#include <tilth/io/column_name.hpp>

namespace tilth {

struct PoseColumns {
  std::size_t count = 0;                                         ///< of each row
  std::array<std::optional<std::size_t>, kPoseQuantities> of{};  ///< where each quantity stands, from 0
  double stamps_in_second = 0.0;                                 ///< 1e9 of nanoseconds; 0: not told
  double position_unit = 1.0;                                    ///< [m]
  std::size_t header_line = 0;                                   ///< that names them, from 1; 0: none does

  const std::optional<std::size_t>& operator[](PoseQuantity quantity) const { return of[std::size_t(quantity)]; }
};

/// stamp [s] tx ty tz [m] qx qy qz qw.
PoseColumns tum_columns();

/// Whether `line` is blank or a comment, which begin with '#', '%' or "//".
bool is_blank_or_comment(std::string_view line);

/// The poses of `text`; without a column of stamps they are numbered from 0. Stamps of a unit that is not told stay as
/// they are. Quaternions are normalised. Throws Error naming file, line and field where a number is missing or not
/// finite, a quaternion is more than 5 % from unit length, or stamps do not ascend.
Trajectory parse_pose_table(std::string_view text, const std::string& name, const PoseColumns& columns);

}  // namespace tilth
