// How the LiDAR's motion within a scan deviates from constant acceleration.
#pragma once

#include <array>

#include <tilth/core/se3.hpp>

namespace tilth {

/// [rad, m] in the frame of the scan's reference time, at regular instants from its beginning to its end; linear in
/// between.
struct ScanVibration {
  static constexpr int kIntervals = 8;
  std::array<Vector6d, kIntervals + 1> knots;

  ScanVibration();

  bool none() const;

  /// `ratio` of the scan that is over, 0 to 1.
  Vector6d at(double ratio) const;
};

/// Standard deviations of the vibration.
struct VibrationSigma {
  double tilt = 0.0;         ///< [rad] about x and y of the LiDAR
  double yaw = 0.0;          ///< [rad] about z, the axis of its spin
  double translation = 0.0;  ///< [m] along each axis

  bool none() const { return tilt == 0.0 || yaw == 0.0 || translation == 0.0; }

  Vector6d variances() const;
};

/// What scans tell about the size of their vibration, in tilt, yaw and translation: sums of squares [rad^2, rad^2, m^2]
/// of the deviations, and how many of these the scans determine.
struct VibrationEvidence {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d freedom = Eigen::Vector3d::Zero();
};

}  // namespace tilth
