#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <tilth/core/error.hpp>
#include <tilth/sources/listed_times.hpp>
#include <tilth/sources/name_times.hpp>
#include <tilth/sources/time_unit.hpp>

namespace tilth {
namespace {

constexpr double kStanding = 1.0 / 3.0;  ///< of the steps are 0: the list does not tell scans apart
constexpr std::size_t kContinued = 10;   ///< one time in so many may be missing at the end
constexpr double kKnownRate = 0.03;      ///< relative: as near to a usual rate of sensors it is that

std::string number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Places in the list by the counters in the names, which count from 0, or from 1 where only so the list fits.
std::optional<std::vector<std::size_t>> places_by_counter(std::span<const std::string> names, std::size_t lines) {
  std::optional<std::vector<std::size_t>> places = counters_in_names(names);
  if (!places || std::adjacent_find(places->begin(), places->end(), std::greater_equal<>()) != places->end())
    return std::nullopt;
  if (places->back() > lines || (places->back() == lines && places->front() == 0)) return std::nullopt;
  if (places->back() == lines)
    for (std::size_t& place : *places) --place;
  return places;
}

/// Takes one time a file out of `times`.
ListedTimes matched(std::vector<double> times, std::span<const std::string> names, const std::string& where) {
  const std::size_t files = names.size(), lines = times.size();
  const std::string counts = std::to_string(lines) + " times for " + std::to_string(files) + " scans";
  if (lines == files) return {std::move(times), ""};
  if (lines < files) {
    const double step = usual_step(times);
    if (lines < 2 || step <= 0.0 || (files - lines) * kContinued > files) {
      throw Error(where, "has " + counts + ": give one a scan, or none and --rate");
    }
    while (times.size() < files) times.push_back(times.back() + step);
    return {std::move(times), "; " + counts + ": the last ones are CONTINUED at the usual step"};
  }
  if (const auto places = places_by_counter(names, lines)) {
    std::vector<double> chosen;
    for (const std::size_t place : *places) chosen.push_back(times[place]);
    return {std::move(chosen), "; " + counts + ", matched by the numbers in the names of the files"};
  }
  times.resize(files);
  return {std::move(times), ", the first " + std::to_string(files) + " of " + std::to_string(lines)};
}

std::size_t standing_steps(const std::vector<double>& times) {
  std::size_t count = 0;
  for (std::size_t k = 1; k < times.size(); ++k) count += times[k] == times[k - 1] ? 1 : 0;
  return count;
}

/// Times of which most are earlier than the one before tell nothing of scans in this order.
void refuse_backwards(const std::vector<double>& times, const std::string& where) {
  std::size_t back = 0;
  for (std::size_t k = 1; k < times.size(); ++k) back += times[k] < times[k - 1] ? 1 : 0;
  if (back < 2 || 2 * back <= times.size() - 1) return;
  throw Error(where, "runs backwards, from " + number("%.3f s", times.front()) + " to " +
                         number("%.3f s", times.back()) +
                         ": bring its lines into the order of the scans, or leave it out and give --rate");
}

/// [s] the period of scans at a usual rate of sensors, if `step` is near it.
double known_step(double step) {
  constexpr std::array<double, 4> kUsual{0.05, 0.1, 0.2, 0.5};
  const auto near = [&](double usual) { return std::abs(step / usual - 1.0) < kKnownRate; };
  const auto it = std::find_if(kUsual.begin(), kUsual.end(), near);
  return it == kUsual.end() ? step : *it;
}

/// Times that stand still between scans, spread evenly from one change to the next.
std::optional<ListedTimes> spread(const std::vector<double>& times, double rate) {
  std::vector<std::size_t> changes;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (times[k] > times[k - 1]) changes.push_back(k);
  if (changes.size() < 2 && (changes.empty() || rate <= 0.0)) return std::nullopt;
  const std::size_t first = changes.front(), last = changes.back();
  const double measured = changes.size() < 2 ? 0.0 : (times[last] - times[first]) / double(last - first);
  const double step = rate > 0.0 ? 1.0 / rate : known_step(measured);
  ListedTimes result{{}, "; they stand still between scans, which are taken for " + number("%.4g s", step) + " apart"};
  for (std::size_t k = 0; k < times.size(); ++k)
    result.times.push_back(times[first] + (double(k) - double(first)) * step);
  return result;
}

}  // namespace

std::optional<ListedTimes> listed_times(const std::vector<double>& list, std::span<const std::string> names,
                                        const std::string& where, double rate) {
  const TimeUnit unit = unit_of_times(list);
  std::vector<double> times = list;
  if (unit.scale != 1.0)
    for (double& time : times) time *= unit.scale;
  const std::string in_unit = unit.scale == 1.0 ? "" : ", in " + std::string(unit.name);
  ListedTimes result = matched(std::move(times), names, where);
  result.decision = in_unit + result.decision;
  refuse_backwards(result.times, where);
  const std::size_t standing = standing_steps(result.times);
  if (standing < 2 || double(standing) < kStanding * double(result.times.size() - 1)) return result;
  std::optional<ListedTimes> even = spread(result.times, rate);
  if (even) even->decision = result.decision + even->decision;
  return even;
}

}  // namespace tilth
