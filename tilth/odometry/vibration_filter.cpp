#include <algorithm>
#include <cmath>

#include <tilth/odometry/vibration_filter.hpp>

namespace tilth {
namespace {

VibrationEvidence first_evidence(const VibrationOptions& options) {
  constexpr double kDeviations = 8;
  const Eigen::Array3d first(options.first_tilt, options.first_tilt, options.first_translation);
  return {kDeviations * first.square().matrix(), Eigen::Vector3d::Constant(kDeviations)};
}

}  // namespace

double mean_gain(double interval) {
  constexpr double kMemory = 3.0;  // [s]
  return 1 - std::exp(-interval / kMemory);
}

VibrationFilter::VibrationFilter(const VibrationOptions& options)
    : options_(options), evidence_(first_evidence(options)) {}

void VibrationFilter::update(double interval, const ScanVibration& vibration, const VibrationEvidence& evidence) {
  constexpr double kMemory = 2.0;  // [s] of the evidence
  const double left = std::exp(-interval / kMemory), gain = mean_gain(interval);
  evidence_ = {left * evidence_.squares + evidence.squares, left * evidence_.freedom + evidence.freedom};
  for (std::size_t i = 0; i < mean_.knots.size(); ++i) mean_.knots[i] += gain * (vibration.knots[i] - mean_.knots[i]);
}

VibrationSigma VibrationFilter::observed() const {
  constexpr double kDoubt = 20;  // deviations that speak for the least one
  const auto sigma = [&](int i, double least) {
    return std::sqrt((evidence_.squares[i] + kDoubt * least * least) / (evidence_.freedom[i] + kDoubt));
  };
  return {sigma(0, options_.least_rotation), sigma(1, options_.least_rotation), sigma(2, options_.least_translation)};
}

VibrationSigma VibrationFilter::sigma() const {
  const auto within = [](double least, double seen, double most) { return std::min(std::max(seen, least), most); };
  const VibrationOptions& o = options_;
  if (o.least_rotation == 0 || o.least_translation == 0) return {};
  const VibrationSigma seen = observed();
  const double tilt = within(o.least_rotation, seen.tilt, o.tilt);
  return {tilt, within(o.least_rotation, seen.yaw, o.yaw + o.yaw_ratio * tilt),
          within(o.least_translation, seen.translation, std::min(o.translation, o.least_translation + o.lever * tilt))};
}

ScanVibration VibrationFilter::without_mean(const ScanVibration& vibration) const {
  ScanVibration rest = vibration;
  for (std::size_t i = 0; i < rest.knots.size(); ++i) rest.knots[i] -= mean_.knots[i];
  return rest;
}

}  // namespace tilth
