// The value in the middle. O(n).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tilth {

/// Of two values in the middle, the larger one. `values` must not be empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace tilth
