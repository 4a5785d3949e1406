// Civil dates as sensors send them, in seconds since 1970. Leap seconds are not counted.
#pragma once

#include <optional>

namespace tilth {

struct CivilTime {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0.0;
};

/// [s] since 1970-01-01 00:00 UTC; nothing where there is no such date from 2000 on. After H. Hinnant's
/// days_from_civil.
std::optional<double> utc_seconds(const CivilTime& time);

/// The date of whole seconds since 1970. After H. Hinnant's civil_from_days.
CivilTime civil_time(double seconds);

}  // namespace tilth
