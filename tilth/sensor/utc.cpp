#include <tilth/sensor/utc.hpp>

namespace tilth {
namespace {

bool in(int value, int low, int high) {
  return value >= low && value <= high;
}

/// Since 1970-01-01. The year begins in March, so that the leap day is its last.
long days_since_1970(int year, int month, int day) {
  const long y = month <= 2 ? year - 1 : year;
  const long era = y / 400, of_era = y - era * 400;
  const long of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

}  // namespace

std::optional<double> utc_seconds(const CivilTime& t) {
  const bool date = in(t.year, 2000, 2199) && in(t.month, 1, 12) && in(t.day, 1, 31);
  const bool clock = in(t.hour, 0, 23) && in(t.minute, 0, 59) && t.second >= 0.0 && t.second < 61.0;
  if (!date || !clock) return std::nullopt;
  return double(days_since_1970(t.year, t.month, t.day)) * 86400.0 + t.hour * 3600.0 + t.minute * 60.0 + t.second;
}

CivilTime civil_time(double seconds) {
  constexpr long long kDay = 86400, kEraDays = 146097, kFromYear0 = 719468;  // days from 0000-03-01 to 1970-01-01
  const auto whole = static_cast<long long>(seconds);
  const long long of_day = whole % kDay, days = whole / kDay + kFromYear0;
  const long long era = days / kEraDays, of_era = days % kEraDays;
  const long long year = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  const long long of_year = of_era - (365 * year + year / 4 - year / 100), month = (5 * of_year + 2) / 153;
  const int calendar_month = int(month < 10 ? month + 3 : month - 9);
  return {int(year + era * 400) + (calendar_month <= 2 ? 1 : 0),
          calendar_month,
          int(of_year - (153 * month + 2) / 5) + 1,
          int(of_day / 3600),
          int(of_day / 60 % 60),
          double(of_day % 60)};
}

}  // namespace tilth
