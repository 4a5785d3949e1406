// Rigid motions. A tangent is [rotation; translation] in [rad; m]; perturbations act on the right: T * exp(xi).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tilth {

using Pose = Eigen::Isometry3d;                ///< T_a_b maps points of frame b into frame a
using Vector6d = Eigen::Matrix<double, 6, 1>;  ///< tangent: rotation [rad], then translation [m]
using Matrix6d = Eigen::Matrix<double, 6, 6>;

Eigen::Matrix3d skew(const Eigen::Vector3d& v);   ///< skew(a) b = a x b
Pose exp(const Vector6d& xi);                     ///< exponential of SE(3)
Vector6d log(const Pose& T);                      ///< inverse of exp; rotation angle in [0, pi]
Matrix6d adjoint(const Pose& T);                  ///< T exp(xi) T^-1 = exp(adjoint(T) xi)
Pose retract(const Pose& T, const Vector6d& xi);  ///< T * exp(xi), re-orthonormalised
Pose normalized(const Pose& T);                   ///< the rotation brought back onto SO(3)
double angle_of(const Pose& T);                   ///< [rad] of its rotation, in [0, pi]

/// The pose a share `s` of the way from `a` (s = 0) to `b` (s = 1) along the screw motion between them, or beyond.
Pose interpolate(const Pose& a, const Pose& b, double s);

}  // namespace tilth
