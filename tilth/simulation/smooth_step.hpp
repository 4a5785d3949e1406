// The quintic that joins two values without a jump in slope or curvature.
#pragma once

#include <algorithm>

namespace tilth {

/// Rises from 0 at x <= 0 to 1 at x >= 1, with vanishing first and second derivatives at both ends.
inline double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

}  // namespace tilth
