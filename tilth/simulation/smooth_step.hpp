// The quintic that joins two values without a jump in slope or curvature.
#pragma once

#include <algorithm>

namespace tilth {

/// Rises from 0 at x <= 0 to 1 at x >= 1, with vanishing first and second derivatives at both ends.
inline double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

/// The integral of smooth_step from 0 to x: x - 1/2 from x = 1 on.
inline double smooth_step_area(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return x - 0.5;
  return x * x * x * x * (2.5 - 3 * x + x * x);
}

}  // namespace tilth
