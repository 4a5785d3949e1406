// The unit of stamps that do not tell it. O(stamps log stamps).
#pragma once

#include <string_view>

#include <tilth/core/trajectory.hpp>

namespace tilth {

struct StampUnit {
  double in_second = 1.0;  ///< 1e9 of nanoseconds
  std::string_view name = "s";
};

/// By the size of the last stamp, in seconds since 1970 (past the year 5000 it must be a smaller unit), and of whole
/// numbers by the median interval, which of seconds is shorter than half an hour.
StampUnit guess_stamp_unit(const Trajectory& trajectory);

}  // namespace tilth
