// Where values stand on an axis, and which round numbers are written beside it. O(ticks).
#pragma once

#include <string>
#include <vector>

namespace tilth {

/// A closed range of values.
struct Range {
  double low = 0.0, high = 1.0;
};

/// The range of the finite `values` and `others` together, widened where it is a single value; [0, 1] without any.
Range range_of(const std::vector<Range>& parts);

/// The smallest and largest finite one of `values`; low > high where there is none.
Range extent(const std::vector<float>& values);

/// `range` grown by `share` of its width on both sides; not past zero where it does not straddle it.
Range padded(const Range& range, double ratio);

/// Maps values of `range` onto [from, to] of the drawing.
struct Scale {
  Range range;
  double from = 0.0, to = 1.0;
  double operator()(double value) const { return from + (value - range.low) / (range.high - range.low) * (to - from); }
};

/// 1, 2 or 5 times a power of ten: the step that puts about `wanted` ticks into `range`.
double tick_step(const Range& range, int wanted);

/// The multiples of `step` within `range`.
std::vector<double> ticks(const Range& range, double step);

/// `value` with the digits that `step` asks for.
std::string tick_text(double value, double step);

}  // namespace tilth
