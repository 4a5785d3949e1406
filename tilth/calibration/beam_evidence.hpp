// What windows of keyframes say together of the errors of beams, and what of it is believed (docs/beams.md).
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <tilth/calibration/beam_options.hpp>
#include <tilth/calibration/beam_window.hpp>
#include <tilth/core/beam_estimate.hpp>

namespace tilth {

/// Errors in units of what was known before: theta = mean + spread y, where y is normal with unit covariance.
struct PriorUnits {
  Eigen::VectorXd mean;
  Eigen::MatrixXd spread;

  /// Of the errors of all beams of `prior`, whose covariance is positive definite.
  explicit PriorUnits(const BeamEstimate& prior);
};

/// What one window, or several as one, says of y: A y = b.
struct WindowEvidence {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double windows = 1;
};

/// Both as one.
WindowEvidence sum_of(WindowEvidence one, const WindowEvidence& other);

/// Of a window that was linearized at theta.
WindowEvidence evidence_of(const BeamWindow& window, const PriorUnits& prior, const Eigen::VectorXd& theta);

struct BeamBelief {
  Eigen::VectorXd y;           ///< 0 in directions that are not believed
  Eigen::MatrixXd covariance;  ///< of y
  std::size_t believed = 0;    ///< directions
};

/// The posterior's mean, with the prior `ridge` times as firm as it is.
Eigen::VectorXd posterior_mean(const std::vector<WindowEvidence>& windows, double ridge);

/// Direction by direction of the parameters' space (eigenvectors of the information): how far the windows scatter about
/// what they say together (the sandwich estimator: H. White, Econometrica 48, 1980), and whether that is enough.
BeamBelief believe(const std::vector<WindowEvidence>& windows, const BeamCalibrationOptions& options);

}  // namespace tilth
