#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tilth/core/median.hpp>
#include <tilth/sensor/point_fields.hpp>
#include <tilth/sensor/time_convention.hpp>
#include <tilth/sensor/time_reference.hpp>

namespace tilth {
namespace {

struct Unit {
  double scale;
  const char* name;
};
constexpr std::array<Unit, 4> kUnits{
    {{1.0, "seconds"}, {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}}};
constexpr double kShortestSpan = 0.008, kLongestSpan = 0.5;  ///< [s] of a scan; less than a factor 1000: one unit fits
constexpr double kShortestPart = 0.2, kLongestPart = 1.5;    ///< of the step between messages that are parts of a turn
constexpr double kFewestSteps = 64.0;                        ///< of float32 within a scan
constexpr double kLargestOutlierRatio = 0.05;

/// float32 holds so few digits at `range` that points of one scan fall on the same few values.
bool too_coarse(const ValueRange& range, FieldType type) {
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

/// Of messages that are parts of a turn, and span about the step from one stamp to the next.
const Unit* unit_of_part(double span, std::span<const CloudStamp> stamps) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k) steps.push_back(stamps[k].stamp - stamps[k - 1].stamp);
  if (steps.empty()) return nullptr;
  const double step = median(std::move(steps));
  const auto it = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) {
    return span * unit.scale > kShortestPart * step && span * unit.scale < kLongestPart * step;
  });
  return it == kUnits.end() || step > kShortestSpan / kShortestPart ? nullptr : &*it;
}

const char* meaning_of(TimeReference reference, double middle) {
  switch (reference) {
    case TimeReference::stamp:
      return middle < 0.0 ? "relative to the end of the scan, which the stamp marks"
                          : "since the start of the scan, which the stamp marks";
    case TimeReference::end_stamp: return "since the start of the scan, while the stamp marks its end";
    case TimeReference::absolute: return "absolute, on the clock of the stamps";
    case TimeReference::other_clock:
      return "absolute on another clock than the stamps, which are taken for the first point";
    case TimeReference::points_clock: return "absolute; they also give the stamps";
  }
  return "";
}

double median_of_finite(std::span<const double> values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
  return finite.empty() ? 0.0 : median(std::move(finite));
}

bool is_relative(TimeReference reference) {
  return reference == TimeReference::stamp || reference == TimeReference::end_stamp;
}

/// [s] of the first point, whose own time is `first`, in a scan of `duration` with the stamp `stamp`.
double stamp_of_first(TimeReference reference, double stamp, double first, double duration) {
  switch (reference) {
    case TimeReference::stamp: return stamp + first;
    case TimeReference::end_stamp: return stamp - duration;
    case TimeReference::other_clock: return stamp;
    case TimeReference::absolute:
    case TimeReference::points_clock: break;
  }
  return first;
}

/// Ranges of the scans whose values tell points apart, with their stamps; the others are counted.
struct Told {
  std::vector<ValueRange> ranges;
  std::vector<CloudStamp> stamps;
  std::size_t coarse = 0, constant = 0;
};

Told told_by(std::span<const std::vector<double>> values, std::span<const CloudStamp> stamps, FieldType type) {
  Told told;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ValueRange range = range_of(values[k]);
    const bool coarse = too_coarse(range, type), constant = !coarse && range.span() == 0.0;
    told.coarse += coarse ? 1 : 0;
    told.constant += constant ? 1 : 0;
    if (coarse || constant) continue;
    told.ranges.push_back(range);
    told.stamps.push_back(stamps[k]);
  }
  return told;
}

}  // namespace

TimeDecision decide_time(std::span<const std::vector<double>> values, std::span<const CloudStamp> stamps,
                         const PointField& field, StampOrigin origin) {
  const std::string name = "time: field '" + field.name + "' (" + name_of(field.type) + ") ";
  const auto [ranges, kept, coarse, constant] = told_by(values, stamps, field.type);
  if (2 * coarse > values.size()) {
    return {{}, false, name + "holds absolute times, for which float32 has too few digits: not used"};
  }
  if (ranges.empty() || 2 * constant > values.size()) {
    return {{}, true, name + "is the same for all points: scans are snapshots, no point times"};
  }
  const double span = median_span(ranges) / 0.98;
  const Unit* unit = unit_of(span);
  if (unit == nullptr) unit = unit_of_part(span, kept);
  if (unit == nullptr) {
    return {{},
            false,
            name + "spans " + std::to_string(span) + " units a scan, which in no unit is 0.008 to 0.5 s: not used"};
  }
  const auto longest =
      std::max_element(ranges.begin(), ranges.end(), [](auto& a, auto& b) { return a.span() < b.span(); });
  TimeConvention convention{unit->scale, reference_of(ranges, kept, unit->scale, origin),
                            longest->span() / 0.98 * unit->scale};
  return {convention, false, name + "in " + unit->name + " " + meaning_of(convention.reference, median_middle(ranges))};
}

std::optional<PointTimes> point_times(const TimeConvention& convention, std::span<const double> values, double stamp) {
  const double middle = median_of_finite(values);
  const double reach = std::max(1.5 * convention.span, 0.15);
  if (is_relative(convention.reference) && std::abs(middle * convention.scale) > kLargestRelativeTime) return {};

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
  if (double(result.outliers.size()) > kLargestOutlierRatio * double(values.size())) return {};
  result.times.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result.times[i] = float(since[i] - first);
  for (const std::uint32_t i : result.outliers) result.times[i] = 0.0f;
  result.stamp = stamp_of_first(convention.reference, stamp, middle * convention.scale + first, last - first);
  return result;
}

}  // namespace tilth
