#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tilth/sensor/point_fields.hpp>
#include <tilth/sensor/time_convention.hpp>

namespace tilth {
namespace {

struct Unit {
  double scale;
  const char* name;
};
constexpr std::array<Unit, 4> kUnits{
    {{1.0, "seconds"}, {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}}};
constexpr double kShortestSpan = 0.003, kLongestSpan = 2.0;  ///< [s] of a scan; less than a factor 1000: one unit fits
constexpr double kLargestRelative = 2.0;                     ///< [s] times further from 0 are absolute
constexpr double kSameClock = 1.5;     ///< [s] absolute times this near to the stamps share their clock
constexpr double kFewestSteps = 64.0;  ///< of float32 within a scan
constexpr double kLargestOutlierShare = 0.05;

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where the bulk of a scan's values lies: 98 of 100; zeros left out where most are not zero (lost packets).
struct Range {
  double low = 0.0, middle = 0.0, high = 0.0;
  double span() const { return high - low; }
};

Range range_of(const std::vector<double>& all) {
  std::vector<double> values;
  std::copy_if(all.begin(), all.end(), std::back_inserter(values),
               [](double v) { return std::isfinite(v) && v != 0.0; });
  if (2 * values.size() < all.size()) values.assign(1, 0.0);
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 100;
  return {values[cut], values[values.size() / 2], values[values.size() - 1 - cut]};
}

std::vector<double> each(std::span<const Range> ranges, double (*f)(const Range&)) {
  std::vector<double> values;
  for (const Range& range : ranges) values.push_back(f(range));
  return values;
}

double span_of(const Range& range) {
  return range.span();
}
double middle_of(const Range& range) {
  return range.middle;
}

/// float32 holds so few digits at `range` that points of one scan fall on the same few values.
bool too_coarse(const Range& range, FieldType type) {
  if (type != FieldType::f32) return false;
  const float value = float(std::abs(range.middle));
  const double step = double(std::nextafter(value, std::numeric_limits<float>::infinity())) - double(value);
  return range.middle != 0.0 && range.span() < kFewestSteps * step;
}

const Unit* unit_of(double span) {
  const auto it = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) {
    return span * unit.scale >= kShortestSpan && span * unit.scale < kLongestSpan;
  });
  return it == kUnits.end() ? nullptr : &*it;
}

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
bool spans_match_step_before(std::span<const Range> ranges, std::span<const CloudStamp> stamps, double scale) {
  std::vector<double> before, after;
  for (std::size_t k = 1; k < ranges.size(); ++k) {
    const double step = stamps[k].stamp - stamps[k - 1].stamp;
    before.push_back(step - ranges[k].span() * scale);
    after.push_back(step - ranges[k - 1].span() * scale);
  }
  if (before.size() < 4) return false;
  const auto scatter = [](std::vector<double> values) {
    const double centre = median(values);
    for (double& v : values) v = std::abs(v - centre);
    return median(values);
  };
  return scatter(after) > 1e-4 && scatter(before) < 0.25 * scatter(after);
}

TimeReference reference_of(std::span<const Range> ranges, std::span<const CloudStamp> stamps, double scale,
                           bool nominal) {
  const double middle = median(each(ranges, middle_of)) * scale;
  if (std::abs(middle) > kLargestRelative) {
    if (nominal) return TimeReference::points_clock;
    std::vector<double> gaps;
    for (std::size_t k = 0; k < ranges.size(); ++k)
      gaps.push_back(std::abs(ranges[k].middle * scale - stamps[k].stamp));
    return median(gaps) < kSameClock ? TimeReference::absolute : TimeReference::other_clock;
  }
  if (middle < 0.0 || nominal) return TimeReference::stamp;
  const double span = median(each(ranges, span_of)) * scale;
  const bool ends = arrives_too_early(stamps, span) || spans_match_step_before(ranges, stamps, scale);
  return ends ? TimeReference::end_stamp : TimeReference::stamp;
}

const char* meaning_of(TimeReference reference, double middle) {
  switch (reference) {
    case TimeReference::stamp:
      return middle < 0.0 ? "relative to the end of the scan, which the stamp marks"
                          : "since the start of the scan, which the stamp marks";
    case TimeReference::end_stamp:
      return "since the start of the scan, while the stamp marks its end";
    case TimeReference::absolute:
      return "absolute, on the clock of the stamps";
    case TimeReference::other_clock:
      return "absolute on another clock than the stamps, which are taken for the first point";
    case TimeReference::points_clock:
      return "absolute; they also give the stamps";
  }
  return "";
}

}  // namespace

TimeDecision decide_time(std::span<const std::vector<double>> values, std::span<const CloudStamp> stamps,
                         const PointField& field, bool nominal_stamps) {
  const std::string name = "time: field '" + field.name + "' (" + name_of(field.type) + ") ";
  std::vector<Range> ranges;
  std::vector<CloudStamp> kept;
  std::size_t coarse = 0, constant = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Range range = range_of(values[k]);
    if (too_coarse(range, field.type))
      ++coarse;
    else if (range.span() == 0.0)
      ++constant;
    else {
      ranges.push_back(range);
      kept.push_back(stamps[k]);
    }
  }
  if (2 * coarse > values.size())
    return {{}, false, name + "holds absolute times, for which float32 has too few digits: not used"};
  if (ranges.empty() || 2 * constant > values.size())
    return {{}, true, name + "is the same for all points: scans are snapshots, no point times"};

  const double span = median(each(ranges, span_of)) / 0.98;
  const Unit* unit = unit_of(span);
  if (unit == nullptr) {
    return {{},
            false,
            name + "spans " + std::to_string(span) + " units a scan, which in no unit is 0.003 to 2 s: not used"};
  }
  const std::vector<double> spans = each(ranges, span_of);
  TimeConvention convention{unit->scale, reference_of(ranges, kept, unit->scale, nominal_stamps),
                            *std::max_element(spans.begin(), spans.end()) / 0.98 * unit->scale};
  return {convention, false,
          name + "in " + unit->name + " " + meaning_of(convention.reference, median(each(ranges, middle_of)))};
}

std::optional<PointTimes> point_times(const TimeConvention& convention, std::span<const double> values, double stamp) {
  const double middle = median({values.begin(), values.end()});
  const double reach = std::max(1.5 * convention.span, 0.15);
  const bool relative =
      convention.reference == TimeReference::stamp || convention.reference == TimeReference::end_stamp;
  if (!std::isfinite(middle) || (relative && std::abs(middle * convention.scale) > kLargestRelative))
    return std::nullopt;

  PointTimes result;
  std::vector<double> since(values.size());
  double first = reach, last = -reach;
  for (std::size_t i = 0; i < values.size(); ++i) {
    since[i] = (values[i] - middle) * convention.scale;
    if (!(std::abs(since[i]) <= reach)) {
      result.outliers.push_back(std::uint32_t(i));
      continue;
    }
    first = std::min(first, since[i]);
    last = std::max(last, since[i]);
  }
  if (double(result.outliers.size()) > kLargestOutlierShare * double(values.size())) return std::nullopt;
  result.times.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result.times[i] = float(since[i] - first);
  for (const std::uint32_t i : result.outliers) result.times[i] = 0.0f;

  const double first_value = middle * convention.scale + first;
  switch (convention.reference) {
    case TimeReference::stamp:
      result.stamp = stamp + first_value;
      break;
    case TimeReference::end_stamp:
      result.stamp = stamp - (last - first);
      break;
    case TimeReference::other_clock:
      result.stamp = stamp;
      break;
    case TimeReference::absolute:
    case TimeReference::points_clock:
      result.stamp = first_value;
      break;
  }
  return result;
}

}  // namespace tilth
