// One matched pair each: its residual at T = T_target_source, and the derivative of the residual with respect to the
// point T * source. Pure mathematics; every type answers the concept Residual.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <tilth/core/se3.hpp>

namespace tilth {

template <class R>
concept Residual = requires(const R& r, const Pose& T) {
  r.residual(T).squaredNorm();
  r.derivative() * r.source;
};

/// d(T p) / d(perturbation) = [-R skew(p), R].
inline Eigen::Matrix<double, 3, 6> point_jacobian(const Pose& T, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 3, 6> J;
  J << -T.linear() * skew(p), T.linear();
  return J;
}

/// Of the residual with respect to a right perturbation of T, rotation first.
template <Residual R>
auto jacobian(const R& r, const Pose& T) {
  return (r.derivative() * point_jacobian(T, r.source)).eval();
}

struct PointToPoint {
  Eigen::Vector3d source, target;

  Eigen::Vector3d residual(const Pose& T) const { return T * source - target; }
  Eigen::Matrix3d derivative() const { return Eigen::Matrix3d::Identity(); }
};

struct PointToPlane {
  Eigen::Vector3d source, target, normal;

  Eigen::Matrix<double, 1, 1> residual(const Pose& T) const {
    return Eigen::Matrix<double, 1, 1>(normal.dot(T * source - target));
  }
  Eigen::RowVector3d derivative() const { return normal.transpose(); }
};

struct PointToLine {
  Eigen::Vector3d source, target, direction;

  Eigen::Vector3d residual(const Pose& T) const { return direction.cross(T * source - target); }
  Eigen::Matrix3d derivative() const { return skew(direction); }
};

/// GICP: the difference of two Gaussians' means, weighed by their joint covariance (Fu et al. 2026, section 2.2):
/// residual(T)^2 = (T p - q)^T (R Sigma_p R^T + Sigma_q)^-1 (T p - q), the squared Mahalanobis distance, with R fixed
/// at construction (docs/method.md, 18).
struct DistributionToDistribution {
  Eigen::Vector3d source, target;
  Eigen::Matrix3d information;  ///< (R Sigma_p R^T + Sigma_q)^-1

  Eigen::Vector3d residual(const Pose& T) const { return derivative() * (T * source - target); }
  Eigen::Matrix3d derivative() const { return information.llt().matrixU(); }
};

/// What a pair's residual e and its derivative D, by the point in the target's frame, have to give.
struct ResidualTerms {
  double squared;               ///< e^T e
  Eigen::Vector3d gradient;     ///< D^T e
  Eigen::Matrix3d information;  ///< D^T D
};

template <Residual R>
ResidualTerms terms_of(const R& r, const Pose& T) {
  const auto e = r.residual(T).eval();
  const auto D = r.derivative();
  return {e.squaredNorm(), D.transpose() * e, D.transpose() * D};
}

inline ResidualTerms terms_of(const DistributionToDistribution& r, const Pose& T) {
  const Eigen::Vector3d offset = T * r.source - r.target, gradient = r.information * offset;
  return {offset.dot(gradient), gradient, r.information};
}

/// The inverse of a covariance, which must be positive definite, from its lower half.
inline Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& C) {
  const double xx = C(1, 1) * C(2, 2) - C(2, 1) * C(2, 1), xy = C(2, 0) * C(2, 1) - C(1, 0) * C(2, 2);
  const double xz = C(1, 0) * C(2, 1) - C(2, 0) * C(1, 1), yy = C(0, 0) * C(2, 2) - C(2, 0) * C(2, 0);
  const double yz = C(1, 0) * C(2, 0) - C(0, 0) * C(2, 1), zz = C(0, 0) * C(1, 1) - C(1, 0) * C(1, 0);
  const double ratio = 1 / (C(0, 0) * xx + C(1, 0) * xy + C(2, 0) * xz);
  Eigen::Matrix3d inverse;
  inverse << ratio * xx, ratio * xy, ratio * xz, ratio * xy, ratio * yy, ratio * yz, ratio * xz, ratio * yz, ratio * zz;
  return inverse;
}

}  // namespace tilth
