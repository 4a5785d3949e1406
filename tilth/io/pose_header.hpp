// The header of a table of poses: which of its names is which column, and in which unit. O(characters).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tilth/io/pose_table.hpp>

namespace tilth {

/// The columns that a header names. Throws Error naming `where` and what is missing, named
/// twice, not told apart, or in a unit that is not known.
PoseColumns columns_of_header(std::string_view line, const std::string& where);

/// Likewise of a comment before rows of `count` cells; nothing where it does not name the columns. Throws Error, also
/// where it tells another order of the quaternion than x y z w without naming every column.
std::optional<PoseColumns> columns_of_comment(std::string_view line, std::size_t count, const std::string& where);

}  // namespace tilth
