#include <algorithm>
#include <cmath>
#include <iterator>

#include <tilth/core/median.hpp>
#include <tilth/sensor/time_reference.hpp>

namespace tilth {
namespace {

constexpr double kSameClock = 1.5;  ///< [s] absolute times this near to the stamps share their clock

/// The recorder had each cloud before its last point was measured, if the stamp were the start: so it is the end.
bool arrives_too_early(std::span<const CloudStamp> stamps, double span) {
  std::vector<double> latency;
  for (const CloudStamp& s : stamps) {
    if (!s.arrival) return false;
    latency.push_back(*s.arrival - s.stamp);
  }
  const auto [low, high] = std::minmax_element(latency.begin(), latency.end());
  const bool real_clock = *low > 1e-4 && *high < 1.0 && *high - *low > 1e-5;
  return real_clock && median(latency) < 0.5 * span;
}

/// Scans follow one another: if their lengths vary, they match the steps between stamps of one end only.
bool spans_match_step_before(std::span<const ValueRange> ranges, std::span<const CloudStamp> stamps, double scale) {
  std::vector<double> before, after;
  for (std::size_t k = 1; k < ranges.size(); ++k) {
    const double step = stamps[k].stamp - stamps[k - 1].stamp;
    before.push_back(step - ranges[k].span() * scale);
    after.push_back(step - ranges[k - 1].span() * scale);
  }
  if (before.size() < 4) return false;
  const auto scatter = [](const std::vector<double>& values) {
    const double centre = median(values);
    double sum = 0.0;
    for (const double v : values) sum += std::abs(v - centre);
    return sum / double(values.size());
  };
  return scatter(after) > 1e-4 && scatter(before) < 0.25 * scatter(after);
}

}  // namespace

ValueRange range_of(std::span<const double> all) {
  std::vector<double> values;
  std::copy_if(all.begin(), all.end(), std::back_inserter(values),
               [](double v) { return std::isfinite(v) && v != 0.0; });
  if (2 * values.size() < all.size()) values.assign(1, 0.0);
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 100;
  return {values[cut], values[values.size() / 2], values[values.size() - 1 - cut]};
}

double median_span(std::span<const ValueRange> ranges) {
  std::vector<double> spans;
  for (const ValueRange& range : ranges) spans.push_back(range.span());
  return median(std::move(spans));
}

double median_middle(std::span<const ValueRange> ranges) {
  std::vector<double> middles;
  for (const ValueRange& range : ranges) middles.push_back(range.middle);
  return median(std::move(middles));
}

TimeReference reference_of(std::span<const ValueRange> ranges, std::span<const CloudStamp> stamps, double scale,
                           StampOrigin origin) {
  const double middle = median_middle(ranges) * scale;
  if (std::abs(middle) > kLargestRelativeTime) {
    if (origin == StampOrigin::order) return TimeReference::points_clock;
    std::vector<double> gaps;
    for (std::size_t k = 0; k < ranges.size(); ++k)
      gaps.push_back(std::abs(ranges[k].middle * scale - stamps[k].stamp));
    if (median(gaps) < kSameClock) return TimeReference::absolute;
    return origin == StampOrigin::recorder ? TimeReference::points_clock : TimeReference::other_clock;
  }
  if (middle < 0.0 || origin == StampOrigin::order) return TimeReference::stamp;
  if (origin == StampOrigin::recorder) return TimeReference::end_stamp;
  const double span = median_span(ranges) * scale;
  const bool ends = arrives_too_early(stamps, span) || spans_match_step_before(ranges, stamps, scale);
  return ends ? TimeReference::end_stamp : TimeReference::stamp;
}

}  // namespace tilth
