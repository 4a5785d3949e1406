// Which instant per-point times count from: told by their size, by when the recorder had the clouds and by how far the
// stamps of scans lie apart. O(n log n) a scan, over the first scans only.
#pragma once

#include <span>
#include <vector>

#include <tilth/sensor/time_convention.hpp>

namespace tilth {

inline constexpr double kLargestRelativeTime = 2.0;  ///< [s] times further from 0 are absolute

/// Where the bulk of a scan's values lies, 98 of 100, in units of the field.
struct ValueRange {
  double low = 0.0, middle = 0.0, high = 0.0;
  double span() const { return high - low; }
};

/// Zeros are left out where most values are not zero (lost packets), values that are not finite always.
ValueRange range_of(std::span<const double> values);

double median_span(std::span<const ValueRange> ranges);
double median_middle(std::span<const ValueRange> ranges);

/// `ranges[k]` belongs to `stamps[k]`; `scale` [s] is one unit.
TimeReference reference_of(std::span<const ValueRange> ranges, std::span<const CloudStamp> stamps, double scale,
                           StampOrigin origin);

}  // namespace tilth
