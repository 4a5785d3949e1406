// The statistics of a list of errors, defined as evo defines them: https://github.com/MichaelGrupp/evo. O(n).
#pragma once

#include <vector>

namespace tilth {

/// What is said of the errors of one kind; in their unit, but sse, which is in its square.
struct Metric {
  double rmse = 0.0;  ///< square root of the mean square
  double mean = 0.0;
  double median = 0.0;  ///< of an even number of errors, the mean of the two in the middle
  double std = 0.0;     ///< of the population: divided by n, not by n - 1
  double min = 0.0;
  double max = 0.0;
  double sse = 0.0;            ///< sum of squares
  std::vector<double> errors;  ///< >= 0, in the order of the trajectory
};

/// The statistics of `errors`. Throws Error where there are none.
Metric metric_of(std::vector<double> errors);

/// `metric` in another unit: every error times `factor`, which must be positive.
Metric scaled(const Metric& metric, double factor);

}  // namespace tilth
