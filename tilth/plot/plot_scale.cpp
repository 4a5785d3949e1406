#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <tilth/plot/plot_scale.hpp>

namespace tilth {

Range range_of(const std::vector<Range>& parts) {
  Range all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Range& part : parts) {
    all.low = std::min(all.low, part.low);
    all.high = std::max(all.high, part.high);
  }
  if (all.low > all.high) return {};
  if (all.high - all.low > 1e-9 * std::max({1e-6, std::abs(all.low), std::abs(all.high)})) return all;
  const double half = all.low == 0.0 ? 0.5 : 0.5 * std::abs(all.low);
  return {all.low - half, all.high + half};
}

Range extent(const std::vector<float>& values) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, double(value));
    range.high = std::max(range.high, double(value));
  }
  return range;
}

Range padded(const Range& range, double ratio) {
  const double more = ratio * (range.high - range.low);
  const double low = range.low >= 0.0 ? std::max(0.0, range.low - more) : range.low - more;
  return {low, range.high + more};
}

double tick_step(const Range& range, int wanted) {
  const double raw = (range.high - range.low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<double> ticks(const Range& range, double step) {
  std::vector<double> values;
  const double first = std::ceil(range.low / step - 1e-9), last = std::floor(range.high / step + 1e-9);
  for (double k = first; k <= last; ++k) values.push_back(k * step + 0.0);
  return values;
}

std::string tick_text(double value, double step) {
  char text[32];
  const double size = std::max(std::abs(value), step);
  if (size >= 1e6 || size < 1e-4) {
    std::snprintf(text, sizeof text, "%g", value);
  } else {
    std::snprintf(text, sizeof text, "%.*f", std::max(0, int(-std::floor(std::log10(step) + 1e-9))), value);
  }
  return text;
}

}  // namespace tilth
