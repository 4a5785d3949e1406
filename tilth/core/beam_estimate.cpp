#include <cassert>
#include <cmath>

#include <Eigen/Eigenvalues>

#include <tilth/core/beam_estimate.hpp>

namespace tilth {

Eigen::VectorXd parameters_of(const BeamModel& model, std::size_t n) {
  const auto size = Eigen::Index(n);
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(Eigen::Index(parameter_count(n)));
  assert(model.range.empty() || model.range.size() == n);
  assert(model.elevation.empty() || model.elevation.size() == n);
  if (!model.range.empty()) theta.head(size) = Eigen::VectorXd::Map(model.range.data(), size);
  if (!model.elevation.empty()) theta.segment(size, size) = Eigen::VectorXd::Map(model.elevation.data(), size);
  theta[2 * size] = model.walk;
  theta.tail<4>() = model.encoder;
  return theta;
}

BeamModel with_parameters(BeamModel model, const Eigen::VectorXd& theta) {
  assert(theta.size() >= 5 && theta.size() % 2 == 1);
  const Eigen::Index n = (theta.size() - 5) / 2;
  model.range.assign(theta.data(), theta.data() + n);
  model.elevation.assign(theta.data() + n, theta.data() + 2 * n);
  model.walk = theta[2 * n];
  model.encoder = theta.tail<4>();
  return model;
}

bool positive_semidefinite(const Eigen::MatrixXd& covariance) {
  constexpr double kRounding = 1e-8;  // of correlations
  if (covariance.size() == 0) return true;
  if (!(covariance.diagonal().minCoeff() >= 0)) return false;
  const Eigen::VectorXd scale =
      covariance.diagonal().unaryExpr([](double v) { return v > 0 ? 1 / std::sqrt(v) : 1 / kRounding; });
  const Eigen::MatrixXd correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  if (!(correlation.cwiseAbs().maxCoeff() <= 1 + kRounding)) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] >= -kRounding;
}

}  // namespace tilth
