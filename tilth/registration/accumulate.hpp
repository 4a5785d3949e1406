// How pairs add to the normal equations, for the sources that instantiate it for their kinds of pairs.
#pragma once

#include <tilth/registration/residual.hpp>

namespace tilth {

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
void add_to(LinearSystem& system, const PairSums& sums, const Eigen::Matrix3d& R_target_source);

template <Residual R>
ResidualTerms terms_of(const R& r, const Pose& T) {
  const auto e = r.residual(T).eval();
  const auto D = r.derivative();
  return {e.squaredNorm(), D.transpose() * e, D.transpose() * D};
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

}  // namespace tilth
