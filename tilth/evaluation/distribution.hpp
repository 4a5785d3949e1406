// What a set of measurements comes to: mean, median, percentiles, maximum. O(n log n).
#pragma once

#include <vector>

namespace tilth {

struct Distribution {
  double mean = 0.0, median = 0.0, p99 = 0.0, max = 0.0;
};

/// Percentiles by linear interpolation between ranks; all zero where there are no values.
Distribution distribution_of(std::vector<double> values);

/// What a box plot draws of a set of values.
struct BoxFigures {
  double p01 = 0.0, q1 = 0.0, median = 0.0, q3 = 0.0, p99 = 0.0, mean = 0.0;
};

/// Likewise.
BoxFigures box_figures(const std::vector<float>& values);

}  // namespace tilth
