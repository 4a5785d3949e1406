#include <Eigen/Eigenvalues>

#include <tilth/core/symmetric6.hpp>

namespace tilth {

Eigen6d eigen_of(const Matrix6d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace tilth
