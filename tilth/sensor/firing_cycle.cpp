#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <tilth/core/median.hpp>
#include <tilth/core/turn.hpp>
#include <tilth/sensor/firing_cycle.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLeastStep = 0.02 * kDegree, kLargestStep = 2.0 * kDegree;  // smaller: two echoes of one shot
constexpr double kNearAxis = 0.2;                                            // [m] no azimuth there
constexpr double kShortestCycle = 44e-6, kLongestCycle = 60e-6;              // [s]
constexpr double kSameRate = 0.03;                                           // relative
constexpr std::size_t kFewestSteps = 100;

/// Azimuth steps between points of the same beam that follow one another.
std::vector<double> steps_of_beams(std::span<const Eigen::Vector3d> points, std::span<const std::uint16_t> rings) {
  std::vector<double> last(std::size_t(*std::max_element(rings.begin(), rings.end())) + 1, NAN), steps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].head<2>().norm() < kNearAxis) continue;
    const double azimuth = std::atan2(points[i].y(), points[i].x());
    const double step = std::abs(std::remainder(azimuth - last[rings[i]], kTurn));
    if (step > kLeastStep && step < kLargestStep) steps.push_back(step);
    last[rings[i]] = azimuth;
  }
  return steps;
}

bool near(double value, double wanted, double tolerance) {
  return std::abs(value / wanted - 1.0) < tolerance;
}

}  // namespace

std::optional<double> column_step(std::span<const Eigen::Vector3d> points, std::span<const std::uint16_t> rings) {
  if (points.empty() || rings.size() != points.size()) return std::nullopt;
  const std::vector<double> steps = steps_of_beams(points, rings);
  if (steps.size() < kFewestSteps) return std::nullopt;
  const double usual = median(steps);
  double sum = 0.0;  // of those without a lost return between: azimuths come in coarse numbers, their mean is fine
  std::size_t count = 0;
  for (const double step : steps) {
    if (!near(step, usual, 0.3)) continue;
    sum += step;
    ++count;
  }
  return sum / double(count);
}

bool fires_as_known(double period, double step) {
  const double columns = kTurn / step, cycle = period / columns;
  if (cycle > kShortestCycle && cycle < kLongestCycle) return true;
  constexpr std::array<double, 3> divided{512, 1024, 2048};
  const bool known_rate = near(period, 0.1, kSameRate) || near(period, 0.05, kSameRate);
  return known_rate && std::any_of(divided.begin(), divided.end(), [&](double n) { return near(columns, n, 0.005); });
}

std::optional<LeftOutTurns> turns_left_out(double scan_step, double turned, double column_step) {
  for (const double usual : {0.1, 0.05, 0.2}) {
    const double left_out = std::round(scan_step / usual - turned);
    const double period = scan_step / (turned + left_out);
    if (left_out >= 1.0 && near(period, usual, kSameRate) && fires_as_known(period, column_step))
      return LeftOutTurns{period, std::size_t(left_out)};
  }
  return std::nullopt;
}

}  // namespace tilth
