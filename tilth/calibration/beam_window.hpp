// What one window of keyframes says of the beams: planes and poses are eliminated, what is left is information and
// gradient of the beams' errors alone. These add up over windows (docs/beams.md).
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <tilth/calibration/beam_calibration.hpp>
#include <tilth/calibration/surface_weights.hpp>

namespace tilth {

/// Parameters are those of beam_estimate.hpp: range [m] and elevation [rad] of each beam, walk [m], encoder [rad].
struct BeamWindow {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;        ///< of half the cost, at the model it was made at
  Eigen::MatrixXd poses_by_beams;  ///< (6 keyframes) x (parameters + 1): how the poses follow; last column: their step
  std::size_t rows = 0;
  double thickness = 0.0;            ///< [m] median of the cells
  Eigen::VectorXd residual, weight;  ///< of each beam: [m] along the beam, weighted sum; sum of weights
};

/// Of windows of one sensor, at least one.
BeamFit fit_of(std::span<const BeamWindow> windows);

/// What rows of `keyframes` keyframes and `rings` beams say, their planes and poses eliminated.
BeamWindow eliminate(const WeightedRows& w, std::size_t rings, std::size_t keyframes);

BeamWindow beam_window(std::span<const BeamKeyframe> keyframes, const BeamModel& beams, std::size_t rings,
                       const BeamCalibrationOptions& options);

/// The keyframes, moved as their poses follow a step of the parameters.
void follow(std::span<BeamKeyframe> keyframes, const BeamWindow& window, const Eigen::VectorXd& step);

}  // namespace tilth
