// Errors of a sensor's beams together with how well they are known. As one vector of parameters of n beams:
//   theta = (range 0 .. n-1 [m], elevation 0 .. n-1 [rad], walk [m], encoder 0 .. 3 [rad])
// Azimuths of single beams and the scale of ranges are no part of it.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <tilth/core/beam_model.hpp>

namespace tilth {

struct BeamEstimate {
  BeamModel model;
  Eigen::MatrixXd covariance;  ///< of theta; 0 x 0: exact, or not known
};

/// Length of theta.
constexpr std::size_t parameter_count(std::size_t beams) {
  return 2 * beams + 5;
}

/// theta of the first n beams, 0 where a list is empty. A list that is not empty must have n beams.
Eigen::VectorXd parameters_of(const BeamModel& model, std::size_t n);

/// `model` with what theta says in the place of its own; theta is of 2 n + 5 values.
BeamModel with_parameters(BeamModel model, const Eigen::VectorXd& theta);

/// Whether a symmetric matrix can be a covariance, rounding aside. O(n^3).
bool positive_semidefinite(const Eigen::MatrixXd& covariance);

}  // namespace tilth
