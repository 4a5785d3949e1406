#include <algorithm>
#include <cmath>
#include <vector>

#include <tilth/core/median.hpp>
#include <tilth/sources/time_unit.hpp>

namespace tilth {
namespace {

constexpr TimeUnit kSeconds{1.0, "seconds"}, kMilli{1e-3, "milliseconds"}, kMicro{1e-6, "microseconds"},
    kNano{1e-9, "nanoseconds"};

/// The first unit in which `value` is less than `limit` [s].
TimeUnit first_below(double value, double limit) {
  for (const TimeUnit& unit : {kSeconds, kMilli, kMicro}) {
    if (value * unit.scale < limit) return unit;
  }
  return kNano;
}

std::vector<double> steps_forward(std::span<const double> times) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k) {
    if (times[k] > times[k - 1]) steps.push_back(times[k] - times[k - 1]);
  }
  return steps;
}

}  // namespace

double usual_step(std::span<const double> times) {
  std::vector<double> steps = steps_forward(times);
  return steps.empty() ? 0.0 : median(std::move(steps));
}

bool is_regular(std::span<const double> times) {
  const double usual = usual_step(times);
  const std::vector<double> steps = steps_forward(times);
  const auto like =
      std::count_if(steps.begin(), steps.end(), [&](double step) { return step > 0.5 * usual && step < 1.5 * usual; });
  return times.size() > 2 && 2 * std::size_t(like) > times.size() - 1;
}

TimeUnit unit_of_times(std::span<const double> times) {
  constexpr double longest_step = 10.0;  // [s]
  constexpr double latest = 1e11;        // [s] since 1970: the year 5138
  const double step = usual_step(times);
  if (step > 0.0 && is_regular(times)) return first_below(step, longest_step);
  return first_below(*std::max_element(times.begin(), times.end()), latest);
}

}  // namespace tilth
