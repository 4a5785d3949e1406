// How the LiDAR's motion within a scan deviates from constant acceleration.
#pragma once

#include <algorithm>
#include <array>

#include <tilth/core/se3.hpp>

namespace tilth {

/// [rad, m] in the frame of the scan's reference time, at regular instants from its beginning to its end; linear in
/// between.
struct ScanVibration {
  static constexpr int kIntervals = 8;
  std::array<Vector6d, kIntervals + 1> knots;

  ScanVibration() { knots.fill(Vector6d::Zero()); }

  bool none() const {
    return std::all_of(knots.begin(), knots.end(), [](const Vector6d& knot) { return knot.isZero(0); });
  }

  /// `ratio` of the scan that is over, 0 to 1.
  Vector6d at(double ratio) const {
    const double place = std::clamp(ratio, 0.0, 1.0) * kIntervals;
    const auto i = std::size_t(std::min(place, double(kIntervals - 1)));
    return knots[i] + (place - double(i)) * (knots[i + 1] - knots[i]);
  }
};

/// Standard deviations of the vibration.
struct VibrationSigma {
  double tilt = 0.0;         ///< [rad] about x and y of the LiDAR
  double yaw = 0.0;          ///< [rad] about z, the axis of its spin
  double translation = 0.0;  ///< [m] along each axis

  bool none() const { return tilt == 0.0 || yaw == 0.0 || translation == 0.0; }

  Vector6d variances() const {
    Vector6d v;
    v << tilt * tilt, tilt * tilt, yaw * yaw, Eigen::Vector3d::Constant(translation * translation);
    return v;
  }
};

/// What scans tell about the size of their vibration, in tilt, yaw and translation: sums of squares [rad^2, rad^2, m^2]
/// of the deviations, and how many of these the scans determine.
struct VibrationEvidence {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d freedom = Eigen::Vector3d::Zero();
};

}  // namespace tilth
