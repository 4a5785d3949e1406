#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <tilth/calibration/beam_evidence.hpp>

namespace tilth {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

WindowEvidence sum_of_all(const std::vector<WindowEvidence>& windows) {
  WindowEvidence sum = windows.front();
  for (std::size_t w = 1; w < windows.size(); ++w) sum = sum_of(std::move(sum), windows[w]);
  return sum;
}

VectorXd mean_of(const WindowEvidence& sum, double ridge) {
  return (sum.A + ridge * MatrixXd::Identity(sum.b.size(), sum.b.size())).ldlt().solve(sum.b);
}

}  // namespace

WindowEvidence sum_of(WindowEvidence one, const WindowEvidence& other) {
  one.A += other.A, one.b += other.b, one.windows += other.windows;
  return one;
}

PriorUnits::PriorUnits(const BeamEstimate& prior)
    : mean(parameters_of(prior.model, prior.model.beams())), spread(prior.covariance.llt().matrixL()) {}

WindowEvidence evidence_of(const BeamWindow& window, const PriorUnits& prior, const VectorXd& theta) {
  return {prior.spread.transpose() * window.information * prior.spread,
          prior.spread.transpose() * (window.information * (theta - prior.mean) - window.gradient)};
}

VectorXd posterior_mean(const std::vector<WindowEvidence>& windows, double ridge) {
  return mean_of(sum_of_all(windows), ridge);
}

BeamBelief believe(const std::vector<WindowEvidence>& windows, const BeamCalibrationOptions& options) {
  const WindowEvidence sum = sum_of_all(windows);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(sum.A);
  const MatrixXd& Q = solver.eigenvectors();
  const VectorXd y = mean_of(sum, 1);
  const Eigen::Index n = y.size();
  VectorXd scatter = VectorXd::Zero(n);
  for (const WindowEvidence& w : windows) scatter += (Q.transpose() * (w.b - w.A * y)).cwiseAbs2();
  const double count = double(windows.size());
  if (count > 1) scatter *= count / (count - 1);
  BeamBelief belief;
  VectorXd in_directions = VectorXd::Zero(n), variances(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double information = std::max(solver.eigenvalues()[j], 0.0);
    const double found = Q.col(j).dot(y);
    const double model_error = options.model_error * sum.windows;
    const double deviation =
        std::sqrt(std::max(scatter[j], information) + model_error * model_error) / (information + 1);
    const double posterior = std::max(deviation * deviation, 1 / (information + 1));
    const bool believed = count > 1 && std::abs(found) > options.significance * deviation;
    if (believed) ++belief.believed, in_directions[j] = found;
    variances[j] = std::min(1.0, believed ? posterior : posterior + found * found);
  }
  belief.y = Q * in_directions;
  belief.covariance = Q * variances.asDiagonal() * Q.transpose();
  return belief;
}

}  // namespace tilth
