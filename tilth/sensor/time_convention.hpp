// What a field of per-point times means: its unit and the instant it counts from, told from the values and the stamps
// of the first scans and then kept. The conventions of drivers: docs/formats/time_and_ring.md. O(n) a scan.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/point_records.hpp>
#include <tilth/sensor/stamp_origin.hpp>

namespace tilth {

/// When a cloud says it was taken.
struct CloudStamp {
  double stamp = 0.0;             ///< [s] of its header, file name or list
  std::optional<double> arrival;  ///< [s] when the recorder received it, where that is known
};

enum class TimeReference {
  stamp,         ///< times count from the stamp, before or after it
  end_stamp,     ///< times count from the start of the scan, the stamp is its end
  absolute,      ///< times are on the clock of the stamps
  other_clock,   ///< times are on a clock of their own, the stamp is taken for the first point
  points_clock,  ///< the stamps are nominal: times on a clock of their own replace them
};

struct TimeConvention {
  double scale = 1.0;  ///< [s] of one unit
  TimeReference reference = TimeReference::stamp;
  double span = 0.1;  ///< [s] from first to last point of the longest of the first scans
};

struct TimeDecision {
  std::optional<TimeConvention> convention;  ///< none: the field tells no times
  bool snapshot = false;                     ///< all points of a scan were taken at once
  std::string sentence;
};

/// `values[k]` holds the field's values of the scan with `stamps[k]`; at least one scan, each with a point.
TimeDecision decide_time(std::span<const std::vector<double>> values, std::span<const CloudStamp> stamps,
                         const PointField& field, StampOrigin origin);

struct PointTimes {
  double stamp = 0.0;                   ///< [s] of the first point
  std::vector<float> times;             ///< [s] >= 0 since `stamp`, one a value
  std::vector<std::uint32_t> outliers;  ///< values that lie in no scan; their times are 0
};

/// Times of one scan, or nothing where its values break the convention.
std::optional<PointTimes> point_times(const TimeConvention& convention, std::span<const double> values, double stamp);

}  // namespace tilth
