#include <algorithm>
#include <cstddef>

#include <tilth/core/scan_vibration.hpp>

namespace tilth {

ScanVibration::ScanVibration() {
  knots.fill(Vector6d::Zero());
}

bool ScanVibration::none() const {
  return std::all_of(knots.begin(), knots.end(), [](const Vector6d& knot) { return knot.isZero(0); });
}

Vector6d ScanVibration::at(double ratio) const {
  const double place = std::clamp(ratio, 0.0, 1.0) * kIntervals;
  const auto i = std::size_t(std::min(place, double(kIntervals - 1)));
  return knots[i] + (place - double(i)) * (knots[i + 1] - knots[i]);
}

Vector6d VibrationSigma::variances() const {
  Vector6d v;
  v << tilt * tilt, tilt * tilt, yaw * yaw, Eigen::Vector3d::Constant(translation * translation);
  return v;
}

}  // namespace tilth
