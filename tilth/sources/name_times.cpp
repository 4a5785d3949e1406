#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <regex>

#include <tilth/sources/name_times.hpp>
#include <tilth/sources/time_unit.hpp>

namespace tilth {
namespace {

/// A name that ends in a number, or in two with a separator between them.
struct TimeName {
  std::string whole, fraction;
  bool words = false;  ///< something stands before the number
};

/// Whatever the locale.
double number(const std::string& digits) {
  double value = 0.0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

/// Digits of seconds since 1970.
bool since_1970(const std::string& seconds) {
  return seconds.size() == 9 || seconds.size() == 10;
}

std::optional<TimeName> parsed(const std::string& name) {
  static const std::regex pair(R"(^(.*?[^0-9.])??([0-9]{1,19})([._-])([0-9]{1,18})(\.pcd)?$)");
  static const std::regex integer(R"(^(.*[^0-9.])?([0-9]{1,19})(\.pcd)?$)");
  std::smatch parts;
  if (std::regex_match(name, parts, pair)) {
    const bool words = parts[1].matched, decimals = parts[3].str() == "." && !words;
    if (decimals || since_1970(parts[2].str())) return TimeName{parts[2].str(), parts[4].str(), words};
  }
  if (!std::regex_match(name, parts, integer)) return std::nullopt;
  return TimeName{parts[2].str(), "", parts[1].matched};
}

std::optional<std::vector<TimeName>> parsed_all(std::span<const std::string> names) {
  std::vector<TimeName> all;
  for (const std::string& name : names) {
    std::optional<TimeName> time = parsed(name);
    if (!time) return std::nullopt;
    all.push_back(std::move(*time));
  }
  const auto has_fraction = [](const TimeName& time) { return !time.fraction.empty(); };
  if (std::any_of(all.begin(), all.end(), has_fraction)) {
    for (TimeName& time : all) time.fraction += time.fraction.empty() ? "0" : "";
  }
  return all;
}

std::vector<double> in_order(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times;
}

/// How many steps between the times, once in order, are about as long as the usual one.
std::size_t regular_steps(const std::vector<double>& times) {
  const std::vector<double> sorted = in_order(times);
  const double usual = usual_step(sorted);
  std::size_t count = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k)
    count += std::abs(sorted[k] - sorted[k - 1] - usual) < 0.5 * usual ? 1 : 0;
  return count;
}

/// Seconds and what follows them: decimals, or a count of smaller units, which has no leading zeros.
NameTimes with_fraction(const std::vector<TimeName>& names) {
  NameTimes best{{}, "stamps: from the names of the files"};
  std::size_t longest = 0, shortest = names[0].fraction.size();
  for (const TimeName& name : names) {
    best.times.push_back(number(name.whole + "." + name.fraction));
    longest = std::max(longest, name.fraction.size());
    shortest = std::min(shortest, name.fraction.size());
  }
  if (longest == shortest) return best;
  struct Unit {
    std::size_t digits;
    double scale;
    const char* name;
  };
  constexpr std::array<Unit, 3> units{{{9, 1e-9, "nanoseconds"}, {6, 1e-6, "microseconds"}, {3, 1e-3, "milliseconds"}}};
  std::size_t most = regular_steps(best.times);
  for (const Unit& unit : units) {
    if (longest > unit.digits) break;
    std::vector<double> times;
    for (const TimeName& name : names) times.push_back(number(name.whole) + number(name.fraction) * unit.scale);
    const std::size_t regular = regular_steps(times);
    if (regular <= most) continue;
    most = regular;
    best = {std::move(times), std::string("stamps: from the names of the files, which are seconds and ") + unit.name +
                                  " without leading zeros: only so do the scans follow one another evenly"};
  }
  return best;
}

/// By their size, or by how far apart they lie.
std::optional<NameTimes> integers(const std::vector<TimeName>& names) {
  std::vector<double> values;
  for (const TimeName& name : names) values.push_back(number(name.whole));
  const std::vector<double> sorted = in_order(values);
  const std::size_t digits = names[0].whole.size();
  const bool alike = std::all_of(names.begin(), names.end(), [&](auto& n) { return n.whole.size() == digits; });
  const bool epoch = alike && names[0].whole[0] != '0' && (digits == 13 || digits == 16 || digits == 19);
  constexpr double least_step = 1e4;  // [units] counters take smaller ones
  const bool counts_time = is_regular(sorted) && usual_step(sorted) >= least_step;
  const bool words = std::any_of(names.begin(), names.end(), [](const TimeName& n) { return n.words; });
  if (!epoch && (words || !counts_time)) return std::nullopt;
  TimeUnit unit{digits == 13   ? 1e-3
                : digits == 16 ? 1e-6
                               : 1e-9,
                digits == 13   ? "milliseconds"
                : digits == 16 ? "microseconds"
                               : "nanoseconds"};
  if (counts_time) unit = unit_of_times(sorted);
  for (double& value : values) value *= unit.scale;
  return NameTimes{std::move(values), "stamps: from the names of the files, in " + std::string(unit.name)};
}

}  // namespace

std::optional<NameTimes> times_in_names(std::span<const std::string> names) {
  const std::optional<std::vector<TimeName>> parsed = parsed_all(names);
  if (!parsed || parsed->empty()) return std::nullopt;
  return parsed->front().fraction.empty() ? integers(*parsed) : std::optional(with_fraction(*parsed));
}

std::optional<std::vector<std::size_t>> counters_in_names(std::span<const std::string> names) {
  const std::optional<std::vector<TimeName>> parsed = parsed_all(names);
  if (!parsed) return std::nullopt;
  std::vector<std::size_t> counters;
  for (const TimeName& name : *parsed) {
    if (!name.fraction.empty() || name.whole.size() > 9) return std::nullopt;
    counters.push_back(std::size_t(std::stoul(name.whole)));
  }
  return counters;
}

}  // namespace tilth
