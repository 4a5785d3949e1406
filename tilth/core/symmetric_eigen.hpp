// The direction in which points spread least, and by how much: the smallest eigenvalue of a covariance and its
// eigenvector, without the trigonometry of a closed form. About 100 operations for what is flat.
#pragma once

#include <tilth/core/symmetric3.hpp>

namespace tilth {

/// Steps towards the least eigenvalue, at most, and the share of it below which a step is the last one.
inline constexpr int kMostEigenvalueSteps = 40;
inline constexpr double kEigenvalueTolerance = 1e-9;

/// The eigenvalues of a covariance [m^2], ascending.
Eigen::Vector3d eigenvalues(const Symmetric3d& covariance);

/// The unit eigenvector of `covariance` to its eigenvalue `least`; any one where several directions have it.
Eigen::Vector3d smallest_eigenvector(const Symmetric3d& covariance, double least);

}  // namespace tilth
