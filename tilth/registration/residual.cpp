#include <Eigen/Cholesky>

#include <tilth/registration/residual.hpp>

namespace tilth {
namespace {

/// Sums over pairs as the target sees them: with M = D^T D of a pair and r its lever, the point less the origin of the
/// source, the moments of M that make up H, and b.
struct PairSums {
  Eigen::Matrix3d H_tt = Eigen::Matrix3d::Zero();  ///< M
  Eigen::Matrix3d H_rt = Eigen::Matrix3d::Zero();  ///< skew(r) M
  Eigen::Matrix3d H_rr = Eigen::Matrix3d::Zero();  ///< skew(r) M skew(r)^T
  Eigen::Vector3d b_r = Eigen::Vector3d::Zero();
  Eigen::Vector3d b_t = Eigen::Vector3d::Zero();

  void add(const Eigen::Matrix3d& M, const Eigen::Vector3d& r, const Eigen::Vector3d& g) {
    Eigen::Matrix3d rM;
    for (int i = 0; i < 3; ++i) rM.col(i) = r.cross(M.col(i));
    H_tt += M;
    H_rt += rM;
    for (int i = 0; i < 3; ++i) H_rr.col(i) += r.cross(rM.row(i));
    b_r += r.cross(g);
    b_t += g;
  }
};

/// Adds what the sums say about a pose with this rotation, perturbed on its right.
void add_to(LinearSystem& system, const PairSums& sums, const Eigen::Matrix3d& R_target_source) {
  const Eigen::Matrix3d &R = R_target_source, Rt = R.transpose();
  const Eigen::Matrix3d H_rt = Rt * sums.H_rt * R;
  system.H.topLeftCorner<3, 3>() += Rt * sums.H_rr * R;
  system.H.topRightCorner<3, 3>() += H_rt;
  system.H.bottomLeftCorner<3, 3>() += H_rt.transpose();
  system.H.bottomRightCorner<3, 3>() += Rt * sums.H_tt * R;
  system.b.head<3>() += Rt * sums.b_r;
  system.b.tail<3>() += Rt * sums.b_t;
}

template <Residual R>
ResidualTerms terms_of(const R& r, const Pose& T) {
  const auto e = r.residual(T).eval();
  const auto D = r.derivative();
  return {e.squaredNorm(), D.transpose() * e, D.transpose() * D};
}

}  // namespace

Eigen::Matrix<double, 3, 6> point_jacobian(const Pose& T, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 3, 6> J;
  J << -T.linear() * skew(p), T.linear();
  return J;
}

Eigen::Vector3d PointToPoint::residual(const Pose& T) const {
  return T * source - target;
}

Eigen::Matrix3d PointToPoint::derivative() const {
  return Eigen::Matrix3d::Identity();
}

Eigen::Matrix<double, 1, 1> PointToPlane::residual(const Pose& T) const {
  return Eigen::Matrix<double, 1, 1>(normal.dot(T * source - target));
}

Eigen::RowVector3d PointToPlane::derivative() const {
  return normal.transpose();
}

Eigen::Vector3d PointToLine::residual(const Pose& T) const {
  return direction.cross(T * source - target);
}

Eigen::Matrix3d PointToLine::derivative() const {
  return skew(direction);
}

Eigen::Vector3d DistributionToDistribution::residual(const Pose& T) const {
  return derivative() * (T * source - target);
}

Eigen::Matrix3d DistributionToDistribution::derivative() const {
  return information.llt().matrixU();
}

ResidualTerms terms_of(const DistributionToDistribution& r, const Pose& T) {
  const Eigen::Vector3d offset = T * r.source - r.target, gradient = r.information * offset;
  return {offset.dot(gradient), gradient, r.information};
}

Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& C) {
  const double xx = C(1, 1) * C(2, 2) - C(2, 1) * C(2, 1), xy = C(2, 0) * C(2, 1) - C(1, 0) * C(2, 2);
  const double xz = C(1, 0) * C(2, 1) - C(2, 0) * C(1, 1), yy = C(0, 0) * C(2, 2) - C(2, 0) * C(2, 0);
  const double yz = C(1, 0) * C(2, 0) - C(0, 0) * C(2, 1), zz = C(0, 0) * C(1, 1) - C(1, 0) * C(1, 0);
  const double ratio = 1 / (C(0, 0) * xx + C(1, 0) * xy + C(2, 0) * xz);
  Eigen::Matrix3d inverse;
  inverse << ratio * xx, ratio * xy, ratio * xz, ratio * xy, ratio * yy, ratio * yz, ratio * xz, ratio * yz, ratio * zz;
  return inverse;
}

// With D the derivative by the point, the Jacobian is D R [-skew(p), I] = D [-skew(R p), I] R: D^T D is all that a pair
// has to give, and R waits for the sums.
template <Residual R>
void accumulate(LinearSystem& system, std::span<const R> residuals, const Pose& T, const RobustKernel& kernel) {
  const Eigen::Matrix3d R_target_source = T.linear();
  PairSums sums;
  for (const R& r : residuals) {
    const ResidualTerms terms = terms_of(r, T);
    const double w = kernel.weight(terms.squared);
    sums.add(w * terms.information, R_target_source * r.source, w * terms.gradient);
    system.error += 0.5 * w * terms.squared;
    system.weight += w;
    system.squared_range += r.source.squaredNorm();
  }
  add_to(system, sums, R_target_source);
  system.matches += residuals.size();
}

template void accumulate(LinearSystem&, std::span<const PointToPoint>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const PointToPlane>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const PointToLine>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const DistributionToDistribution>, const Pose&, const RobustKernel&);

}  // namespace tilth
