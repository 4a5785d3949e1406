#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <tilth/sensor/spin.hpp>

namespace tilth {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kShortestPeriod = 0.04, kLongestPeriod = 0.25;  ///< [s] LiDARs spin at 5 to 20 Hz
constexpr double kUsualPeriod = 0.1;                             ///< [s]
constexpr double kFixedCut = 0.5 * kDegree;  ///< scans that begin within this are cut at a fixed azimuth
constexpr double kContinues = 2 * kDegree;   ///< a scan begins where the one before ended

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

}  // namespace

double delay_of_first(const HeadRotation& rotation, double cut, double period) {
  const double late = (rotation.clockwise ? -1 : 1) * std::remainder(rotation.begin - cut, kTurn);
  const bool ends_before_cut = late + rotation.covered() < kTurn + kContinues;  // else the cut has wandered
  return late > kFixedCut && ends_before_cut ? late / kTurn * period : 0.0;
}

SpinDecision measure_spin(std::span<const HeadRotation> rotations, std::span<const double> stamps,
                          bool nominal_stamps) {
  std::vector<double> periods;
  for (std::size_t k = 1; k < rotations.size(); ++k) {
    const double turned = rotations[k - 1].covered() + gap(rotations[k - 1], rotations[k]);
    const double step = stamps[k] - stamps[k - 1];
    if (step > 0.0 && turned > kDegree) periods.push_back(step * kTurn / turned);
  }
  const std::optional<double> cut = fixed_cut(rotations);
  const Succession order = succession(rotations);
  const std::string begin = derived(rotations.front());
  if (nominal_stamps && order == Succession::leaves_out) {
    return {{},
            {},
            "time: no field, and scans do not begin where the one before ended while the stamps are nominal: no point "
            "times"};
  }
  const double period = periods.empty() ? 0.0 : median(periods);
  if (period < kShortestPeriod || period > kLongestPeriod) {
    return {kUsualPeriod, cut,
            begin + ", spin period ASSUMED " + number("%.4f", kUsualPeriod) + " s: " +
                (periods.empty() ? "one scan tells none"
                                 : "the stamps give " + number("%.4f", period) + " s, which is no spin")};
  }
  const std::string measured = begin + ", spin period " + number("%.4f", period) + " s";
  if (!nominal_stamps) return {period, cut, measured + " from the stamps"};
  if (order == Succession::follows)
    return {period, cut, measured + " from the nominal rate; each scan begins where the one before ended"};
  return {period, cut, measured + ", a GUESS from the nominal rate"};
}

}  // namespace tilth
