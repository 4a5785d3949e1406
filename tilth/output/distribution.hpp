// What a set of measurements comes to: mean, median, 99th percentile, maximum. O(n log n).
#pragma once

#include <vector>

namespace tilth {

struct Distribution {
  double mean = 0.0, median = 0.0, p99 = 0.0, max = 0.0;
};

/// Percentiles by linear interpolation between ranks; all zero where there are no values.
Distribution distribution_of(std::vector<double> values);

}  // namespace tilth
