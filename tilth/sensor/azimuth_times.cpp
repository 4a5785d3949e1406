#include <cmath>
#include <numbers>

#include <tilth/sensor/azimuth_times.hpp>

namespace tilth {

std::vector<double> times_by_azimuth(std::span<const Eigen::Vector3d> points, const TurningHead& head) {
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<double> times;
  times.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const double turned = (head.clockwise ? -1.0 : 1.0) * (std::atan2(point.y(), point.x()) - head.cut);
    times.push_back((turned / turn - std::floor(turned / turn)) * head.period);
  }
  return times;
}

}  // namespace tilth
