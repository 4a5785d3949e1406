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

/// GICP: the difference of two Gaussians' means, whitened by their joint covariance (Fu et al. 2026, section 2.2):
/// residual(T)^2 = (T p - q)^T (R Sigma_p R^T + Sigma_q)^-1 (T p - q), with R fixed at construction.
struct DistributionToDistribution {
  Eigen::Vector3d source, target;
  Eigen::Matrix3d whitening;  ///< W with W^T W = (R Sigma_p R^T + Sigma_q)^-1; lower triangular

  Eigen::Vector3d residual(const Pose& T) const { return whitening * (T * source - target); }
  const Eigen::Matrix3d& derivative() const { return whitening; }
};

/// W with W^T W = covariance^-1: the inverse of the Cholesky factor. `covariance` must be positive definite.
inline Eigen::Matrix3d whitening_of(const Eigen::Matrix3d& covariance) {
  const double a = std::sqrt(covariance(0, 0)), b = covariance(1, 0) / a, c = covariance(2, 0) / a;
  const double d = std::sqrt(covariance(1, 1) - b * b), e = (covariance(2, 1) - c * b) / d;
  const double f = std::sqrt(covariance(2, 2) - c * c - e * e);
  Eigen::Matrix3d W;
  W << 1 / a, 0, 0, -b / (a * d), 1 / d, 0, (b * e - c * d) / (a * d * f), -e / (d * f), 1 / f;
  return W;
}

}  // namespace tilth
