// The vibration of the platform from scan to scan: how large it is, as the last scans have shown it (empirical Bayes,
// after MacKay 1992), and what stays of it, which is an error of the map.
#pragma once

#include <tilth/core/scan_vibration.hpp>
#include <tilth/registration/vibration_options.hpp>

namespace tilth {

/// The weight of a scan in the mean of about three seconds, `interval` [s] after the last one.
double mean_gain(double interval);

class VibrationFilter {
 public:
  /// At first a platform may shake, until scans show that it does not: a deviation that began at its least would be
  /// slow to leave it, for as long as the map takes up what vibration there is.
  explicit VibrationFilter(const VibrationOptions& options);

  /// Takes the vibration of a scan, `interval` [s] after the last one, and what it tells about the size of vibrations.
  void update(double interval, const ScanVibration& vibration, const VibrationEvidence& evidence);

  /// As the scans of about the last two seconds have shown it (docs/method.md, 11).
  VibrationSigma observed() const;

  /// The same within the bounds of the options, by which parts of the map stay together.
  VibrationSigma sigma() const;

  /// Of the vibrations of about the last three seconds.
  const ScanVibration& mean() const { return mean_; }

  /// What of a vibration goes to and fro. The mean that it is seen about is an error of the map: what is put into the
  /// map without it lets the map come to rest where no instant of a scan leads another.
  ScanVibration without_mean(const ScanVibration& vibration) const;

 private:
  VibrationOptions options_;
  VibrationEvidence evidence_;
  ScanVibration mean_;
};

}  // namespace tilth
