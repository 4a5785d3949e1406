#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include <tilth/core/median.hpp>
#include <tilth/core/turn.hpp>
#include <tilth/sensor/firing_cycle.hpp>
#include <tilth/sensor/spin.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kShortestPeriod = 0.04, kLongestPeriod = 0.25;  ///< [s] LiDARs spin at 5 to 20 Hz
constexpr double kUsualPeriod = 0.1;                             ///< [s]
constexpr double kUsual = 0.05;                                  ///< relative: a period as near to it is the usual one
constexpr double kFixedCut = 0.5 * kDegree;  ///< scans that begin within this are cut at a fixed azimuth
constexpr double kContinues = 2 * kDegree;   ///< a scan begins where the one before ended

/// [rad] turned from the end of `a` to the beginning of `b`, as the nearest of all whole turns.
double gap(const HeadRotation& a, const HeadRotation& b) {
  return std::remainder((a.clockwise ? -1 : 1) * (b.begin - a.end()), kTurn);
}

std::string number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string derived(const HeadRotation& rotation) {
  return std::string("time: no field, derived from the order of firing (") +
         (rotation.clockwise ? "clockwise" : "counter-clockwise") + ", " +
         number("%.1f", rotation.covered() / kDegree) + " deg a scan)";
}

/// Where all scans begin, if they do so at the same azimuth.
std::optional<double> fixed_cut(std::span<const HeadRotation> rotations) {
  if (rotations.size() < 2) return std::nullopt;
  std::vector<double> starts;
  for (const HeadRotation& rotation : rotations)
    starts.push_back(std::remainder(rotation.begin - rotations[0].begin, kTurn));
  const double centre = median(starts);
  for (double& start : starts) start = std::abs(start - centre);
  if (median(std::move(starts)) > kFixedCut) return std::nullopt;
  return rotations[0].begin + centre;
}

enum class Succession { unknown, follows, leaves_out };

/// Whether scans follow without a gap, which only scans tell that are not all cut at the same azimuth.
Succession succession(std::span<const HeadRotation> rotations) {
  if (rotations.size() < 2 || fixed_cut(rotations)) return Succession::unknown;
  std::vector<double> gaps;
  for (std::size_t k = 1; k < rotations.size(); ++k) gaps.push_back(std::abs(gap(rotations[k - 1], rotations[k])));
  return median(gaps) < kContinues ? Succession::follows : Succession::leaves_out;
}

/// What the stamps of consecutive scans say; medians.
struct StampedTurns {
  double step = 0.0;    ///< [s] from scan to scan; 0: nothing tells it
  double turned = 0.0;  ///< [turns] from scan to scan, whole ones left out
  double period = 0.0;  ///< [s] of one turn, if none was left out
};

StampedTurns turns_between(std::span<const HeadRotation> rotations, std::span<const double> stamps) {
  std::vector<double> steps, turns, periods;
  for (std::size_t k = 1; k < rotations.size(); ++k) {
    const double turned = rotations[k - 1].covered() + gap(rotations[k - 1], rotations[k]);
    const double step = stamps[k] - stamps[k - 1];
    if (step <= 0.0 || turned <= kDegree) continue;
    steps.push_back(step);
    turns.push_back(turned / kTurn);
    periods.push_back(step * kTurn / turned);
  }
  if (steps.empty()) return {};
  return {median(std::move(steps)), median(std::move(turns)), median(std::move(periods))};
}

bool is_spin(double period) {
  return period >= kShortestPeriod && period <= kLongestPeriod;
}

/// Where a sensor fires as known ones do only if turns were not recorded. Sensors turn in 0.1 s where nothing else is
/// known: then columns may as well have been thinned out.
std::optional<LeftOutTurns> left_out(const StampedTurns& stamped, const std::optional<double>& column_step) {
  if (!column_step || stamped.step <= 0.0) return std::nullopt;
  if (is_spin(stamped.period) && fires_as_known(stamped.period, *column_step)) return std::nullopt;
  if (std::abs(stamped.period / kUsualPeriod - 1.0) < kUsual) return std::nullopt;
  return turns_left_out(stamped.step, stamped.turned, *column_step);
}

/// As many turns as bring the period nearest to one that is about known.
std::optional<LeftOutTurns> left_out_beside(const StampedTurns& stamped, double about) {
  constexpr std::size_t kMost = 20;
  if (stamped.step <= 0.0) return std::nullopt;
  LeftOutTurns best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t turns = 0; turns <= kMost; ++turns) {
    const double period = stamped.step / (stamped.turned + double(turns));
    const double apart = std::abs(std::log(period / about));
    if (apart < nearest) nearest = apart, best = {period, turns};
  }
  return best.turns > 0 ? std::optional(best) : std::nullopt;
}

std::string sentence_of(const LeftOutTurns& fewer, double step, const SpinHints& hints) {
  return ", spin period " + number("%.4f", fewer.period) + " s and " + std::to_string(fewer.turns) + " of " +
         std::to_string(fewer.turns + 1) +
         (hints.about ? " turns lie between these scans: those with times tell how long a turn takes"
                      : " turns not recorded: a beam's points lie " + number("%.3f", *hints.column_step / kDegree) +
                            " deg apart, as sensors fire at that rate") +
         ", and scans " + number("%.4f", step) + " s";
}

}  // namespace

double delay_of_first(const HeadRotation& rotation, double cut, double period) {
  const double late = (rotation.clockwise ? -1 : 1) * std::remainder(rotation.begin - cut, kTurn);
  const bool ends_before_cut = late + rotation.covered() < kTurn + kContinues;  // else the cut has wandered
  return late > kFixedCut && ends_before_cut ? late / kTurn * period : 0.0;
}

SpinDecision measure_spin(std::span<const HeadRotation> rotations, std::span<const double> stamps, bool nominal_stamps,
                          const SpinHints& hints) {
  const StampedTurns stamped = turns_between(rotations, stamps);
  const std::optional<double> cut = fixed_cut(rotations);
  const Succession order = succession(rotations);
  const std::string begin = derived(rotations.front());
  if (nominal_stamps && order == Succession::leaves_out) {
    return {{},
            {},
            "time: no field, and scans do not begin where the one before ended while the stamps are nominal: no point "
            "times"};
  }
  std::optional<LeftOutTurns> fewer;
  if (hints.about)
    fewer = left_out_beside(stamped, *hints.about);
  else if (!nominal_stamps && order != Succession::follows)
    fewer = left_out(stamped, hints.column_step);
  if (fewer) return {fewer->period, cut, begin + sentence_of(*fewer, stamped.step, hints)};
  if (!is_spin(stamped.period)) {
    return {kUsualPeriod, cut,
            begin + ", spin period ASSUMED " + number("%.4f", kUsualPeriod) + " s: " +
                (stamped.step <= 0.0 ? "one scan tells none"
                                     : "the stamps give " + number("%.4f", stamped.period) + " s, which is no spin")};
  }
  const std::string measured = begin + ", spin period " + number("%.4f", stamped.period) + " s";
  if (!nominal_stamps) return {stamped.period, cut, measured + " from the stamps"};
  if (order == Succession::follows)
    return {stamped.period, cut, measured + " from the nominal rate; each scan begins where the one before ended"};
  return {stamped.period, cut, measured + ", a GUESS from the nominal rate"};
}

}  // namespace tilth
