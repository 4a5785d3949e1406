#include <cmath>

#include <tilth/core/turn.hpp>
#include <tilth/preprocess/azimuth_times.hpp>

namespace tilth {
namespace {

// [rad] clockwise from +x.
double clockwise(const Eigen::Vector3d& p) {
  return -std::atan2(p.y(), p.x());
}

}  // namespace

std::vector<float> azimuth_times(const PointCloud& cloud, double period) {
  if (cloud.empty()) return {};
  const double start = clockwise(cloud.points.front());
  double span = clockwise(cloud.points.back()) + kTurn - start;
  if (span > 1.5 * kTurn) span -= kTurn;
  if (span < 0.5 * kTurn) span += kTurn;
  std::vector<float> times;
  times.reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.points) {
    const double turned = clockwise(p) - start;
    times.push_back(float((turned < 0 ? turned + kTurn : turned) / span * period));
  }
  return times;
}

}  // namespace tilth
