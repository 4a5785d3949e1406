#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <tilth/core/median.hpp>
#include <tilth/io/stamp_unit.hpp>

namespace tilth {
namespace {

constexpr std::array kSmaller{StampUnit{1e3, "ms"}, StampUnit{1e6, "us"}, StampUnit{1e9, "ns"}};
constexpr double kFarFuture = 1e11;        // [s] since 1970
constexpr double kLongInterval = 2e3;      // [s]
constexpr double kLongMicroseconds = 1e6;  // [us] poses once a second are rarer than such at 1000 Hz

double median_interval(const Trajectory& trajectory) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    intervals.push_back(trajectory[i].stamp - trajectory[i - 1].stamp);
  return intervals.empty() ? 0 : median(std::move(intervals));
}

}  // namespace

StampUnit guess_stamp_unit(const Trajectory& trajectory) {
  if (trajectory.empty()) return {};
  const double last = std::abs(trajectory.back().stamp);
  for (auto unit = kSmaller.rbegin(); unit != kSmaller.rend(); ++unit) {
    if (last >= kFarFuture * unit->in_second / 1e3) return *unit;
  }
  const auto whole = [](const StampedPose& pose) { return std::floor(pose.stamp) == pose.stamp; };
  const double interval = median_interval(trajectory);
  if (interval < kLongInterval || !std::all_of(trajectory.begin(), trajectory.end(), whole)) return {};
  return interval < kLongMicroseconds ? kSmaller[1] : kSmaller[2];
}

}  // namespace tilth
