// The unit of a list of times of scans, told by how far apart they lie. O(n log n).
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace tilth {

struct TimeUnit {
  double scale = 1.0;  ///< [s] of one unit
  std::string_view name = "seconds";
};

/// [units] the median of the steps that lead forward, `times` being in the order of scans; 0 where there is none.
double usual_step(std::span<const double> times);

/// Most steps are about as long as the usual one.
bool is_regular(std::span<const double> times);

/// By the usual step: scans follow one another within 0.01 to 10 s; by the size of the values where that tells none.
TimeUnit unit_of_times(std::span<const double> times);

}  // namespace tilth
