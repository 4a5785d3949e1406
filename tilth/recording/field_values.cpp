#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include <tilth/recording/field_values.hpp>
#include <tilth/sensor/time_reference.hpp>

namespace tilth {
namespace {

constexpr double kLargestRing = 1023, kFewestBeams = 16;
constexpr double kStrayRatio = 0.05;  ///< of the points, on rings beyond a gap: fewer are no beams
constexpr double kUsableRatio = 0.5;  ///< of the rings of a scan that are good
constexpr double kUsableTimes = 0.3;  ///< of its times: in a thinned scan they still tell when
constexpr double kUsualSpread = 1.6;  ///< spans between the first and the last time of a good scan
constexpr double kWindow = 1.25;      ///< spans within which a scan's good times lie
constexpr double kFar = 2.0;          ///< spans from that window: a bad time

bool is_ring(double value) {
  return value >= 0.0 && value <= kLargestRing && value == std::floor(value);
}

/// Above `largest`, the rings that a sensor with that one may have beside: beams come in powers of two.
double limit_above(double largest) {
  return std::max(kFewestBeams, double(std::bit_ceil(std::uint32_t(largest) + 1)));
}

template <class Good>
ValueCheck checked(std::span<const double> values, double usable, const Good& is_good) {
  ValueCheck check;
  check.bad = std::size_t(std::count_if(values.begin(), values.end(), [&](double v) { return !is_good(v); }));
  if (check.bad == 0) return check;
  check.unusable = double(values.size() - check.bad) < usable * double(values.size());
  check.keep.reserve(values.size());
  for (const double value : values) check.keep.push_back(is_good(value) ? 1 : 0);
  return check;
}

}  // namespace

RingValues::RingValues(std::span<const std::vector<double>> first_scans) {
  std::map<double, std::size_t> count;
  std::size_t all = 0, rings = 0;
  for (const std::vector<double>& values : first_scans) {
    all += values.size();
    for (const double value : values) {
      if (is_ring(value)) ++count[value], ++rings;
    }
  }
  if (count.size() < 2 || double(rings) < kUsableRatio * double(all)) return;
  double limit = limit_above(count.begin()->first);
  std::size_t below = 0;
  for (const auto& [value, n] : count) {
    if (value >= limit && double(rings - below) < kStrayRatio * double(rings)) break;
    limit = limit_above(value);
    below += n;
  }
  limit_ = limit;
}

ValueCheck RingValues::check(std::span<const double> values) const {
  if (limit_ == 0.0) return {};
  return checked(values, kUsableRatio, [&](double value) { return is_ring(value) && value < limit_; });
}

TimeValues::TimeValues(std::span<const std::vector<double>> first_scans) {
  std::vector<ValueRange> ranges;
  for (const std::vector<double>& values : first_scans) {
    if (!values.empty()) ranges.push_back(range_of(values));
  }
  if (!ranges.empty()) span_ = median_span(ranges);
}

ValueCheck TimeValues::check(std::span<const double> values) const {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
  if (span_ == 0.0 || sorted.empty()) return {};
  const auto [low, high] = std::minmax_element(sorted.begin(), sorted.end());
  if (sorted.size() == values.size() && *high - *low <= kUsualSpread * span_) return {};
  std::sort(sorted.begin(), sorted.end());
  std::size_t best = 0, most = 0;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); ++begin) {
    while (end < sorted.size() && sorted[end] <= sorted[begin] + kWindow * span_) ++end;
    if (end - begin > most) best = begin, most = end - begin;
  }
  const double first = sorted[best] - kFar * span_, last = sorted[best] + (kWindow + kFar) * span_;
  return checked(values, kUsableTimes, [=](double value) { return value >= first && value <= last; });
}

}  // namespace tilth
