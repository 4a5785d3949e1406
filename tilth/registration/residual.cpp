#include <Eigen/Cholesky>

#include <tilth/registration/accumulate.hpp>

namespace tilth {

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

template void accumulate(LinearSystem&, std::span<const PointToPoint>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const PointToPlane>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const PointToLine>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const DistributionToDistribution>, const Pose&, const RobustKernel&);

}  // namespace tilth
