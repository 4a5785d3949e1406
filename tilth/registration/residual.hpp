// One matched pair each: its residual at T = T_target_source, and the derivative of the residual with respect to the
// point T * source; and what all pairs add to the normal equations. Pure mathematics; every type answers the concept
// Residual.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <tilth/core/se3.hpp>
#include <tilth/registration/robust_kernel.hpp>

namespace tilth {

template <class R>
concept Residual = requires(const R& r, const Pose& T) {
  r.residual(T).squaredNorm();
  r.derivative() * r.source;
};

/// d(T p) / d(perturbation) = [-R skew(p), R].
Eigen::Matrix<double, 3, 6> point_jacobian(const Pose& T, const Eigen::Vector3d& p);

/// Of the residual with respect to a right perturbation of T, rotation first.
template <Residual R>
auto jacobian(const R& r, const Pose& T) {
  return (r.derivative() * point_jacobian(T, r.source)).eval();
}

struct PointToPoint {
  Eigen::Vector3d source, target;

  Eigen::Vector3d residual(const Pose& T) const;
  Eigen::Matrix3d derivative() const;
};

struct PointToPlane {
  Eigen::Vector3d source, target, normal;

  Eigen::Matrix<double, 1, 1> residual(const Pose& T) const;
  Eigen::RowVector3d derivative() const;
};

struct PointToLine {
  Eigen::Vector3d source, target, direction;

  Eigen::Vector3d residual(const Pose& T) const;
  Eigen::Matrix3d derivative() const;
};

/// GICP: the difference of two Gaussians' means, weighed by their joint covariance (Fu et al. 2026, section 2.2):
/// residual(T)^2 = (T p - q)^T (R Sigma_p R^T + Sigma_q)^-1 (T p - q), the squared Mahalanobis distance, with R fixed
/// at construction (docs/method.md, 18).
struct DistributionToDistribution {
  Eigen::Vector3d source, target;
  Eigen::Matrix3d information;  ///< (R Sigma_p R^T + Sigma_q)^-1

  Eigen::Vector3d residual(const Pose& T) const;
  Eigen::Matrix3d derivative() const;
};

/// What a pair's residual e and its derivative D, by the point in the target's frame, have to give.
struct ResidualTerms {
  double squared;               ///< e^T e
  Eigen::Vector3d gradient;     ///< D^T e
  Eigen::Matrix3d information;  ///< D^T D
};

ResidualTerms terms_of(const DistributionToDistribution& r, const Pose& T);

/// The inverse of a covariance, which must be positive definite, from its lower half.
Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& C);

/// Normal equations H x = -b of all pairs, and what else one pass over them gives.
struct LinearSystem {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double error = 0.0;          ///< 1/2 sum of weighted squared residuals
  double weight = 0.0;         ///< sum of the kernel's weights
  double squared_range = 0.0;  ///< [m^2] sum over the source points
  std::size_t matches = 0;
};

/// Adds the pairs at T.
template <Residual R>
void accumulate(LinearSystem& system, std::span<const R> residuals, const Pose& T, const RobustKernel& kernel);

extern template void accumulate(LinearSystem&, std::span<const PointToPoint>, const Pose&, const RobustKernel&);
extern template void accumulate(LinearSystem&, std::span<const PointToPlane>, const Pose&, const RobustKernel&);
extern template void accumulate(LinearSystem&, std::span<const PointToLine>, const Pose&, const RobustKernel&);
extern template void accumulate(LinearSystem&, std::span<const DistributionToDistribution>, const Pose&,
                                const RobustKernel&);

}  // namespace tilth
