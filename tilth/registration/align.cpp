#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <tilth/registration/align.hpp>

namespace tilth {

bool solve(const LinearSystem& system, Vector6d& step) {
  const Eigen::LDLT<Matrix6d> factor(system.H);
  step = factor.solve(-system.b);
  return factor.info() == Eigen::Success && step.allFinite();
}

void diagnose(const LinearSystem& system, double degeneracy_ratio, AlignResult& result) {
  result.matches = system.matches;
  result.error = system.error;
  result.information = system.H;
  // Rotations in units of the arc they move a typical point by, so that all six directions compare in metres.
  const double range = std::sqrt(system.squared_range / std::max<double>(1.0, double(system.matches)));
  Vector6d scale = Vector6d::Ones();
  scale.head<3>().setConstant(range > 0 ? 1 / range : 1.0);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scale.asDiagonal() * system.H * scale.asDiagonal());
  const double strongest = eigen.eigenvalues()[5];
  const double weakest = std::max(degeneracy_ratio * strongest, 1e-9);
  result.degenerate_directions = int((eigen.eigenvalues().array() < weakest).count());
  const double freedom = std::max(1.0, 3.0 * double(system.matches) - 6.0);
  const double variance = system.matches == 0 ? 1.0 : std::max(2 * system.error / freedom, 1e-12);
  const Vector6d inverse = eigen.eigenvalues().cwiseMax(1e-9).cwiseInverse();
  const Matrix6d scaled = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  result.covariance = variance * (scale.asDiagonal() * scaled * scale.asDiagonal());
}

}  // namespace tilth
