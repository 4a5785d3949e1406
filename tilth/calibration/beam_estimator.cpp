#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <tilth/calibration/beam_estimator.hpp>
#include <tilth/calibration/beam_window.hpp>
#include <tilth/core/median.hpp>
#include <tilth/core/parallel.hpp>

namespace tilth {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kStrict = 2;  // last iterations, in which only what is believed is applied

/// The problem in units of the prior: theta = mean + spread y, where y is normal with unit covariance.
struct PriorUnits {
  VectorXd mean;
  MatrixXd spread;
};

/// What the windows say of y: each A y = b, and their sums.
struct Evidence {
  std::vector<MatrixXd> A;
  std::vector<VectorXd> b;
  MatrixXd sum_A;
  VectorXd sum_b;
};

struct Belief {
  VectorXd y;
  MatrixXd covariance;  // of y
  std::size_t believed = 0;
};

std::vector<BeamWindow> linearize(const KeyframeWindows& windows, const BeamModel& beams, std::size_t rings,
                                  const BeamCalibrationOptions& options) {
  std::vector<BeamWindow> result(windows.size());
  parallel_for(windows.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[i] = beam_window(windows[i], beams, rings, options);
  });
  return result;
}

Evidence evidence_of(const std::vector<BeamWindow>& windows, const PriorUnits& prior, const VectorXd& theta) {
  Evidence evidence;
  const Eigen::Index n = theta.size();
  evidence.sum_A = MatrixXd::Zero(n, n), evidence.sum_b = VectorXd::Zero(n);
  for (const BeamWindow& w : windows) {
    evidence.A.push_back(prior.spread.transpose() * w.information * prior.spread);
    evidence.b.push_back(prior.spread.transpose() * (w.information * (theta - prior.mean) - w.gradient));
    evidence.sum_A += evidence.A.back(), evidence.sum_b += evidence.b.back();
  }
  return evidence;
}

/// The posterior's mean, with the prior `ridge` times as firm as it is.
VectorXd posterior_mean(const Evidence& evidence, double ridge) {
  const Eigen::Index n = evidence.sum_b.size();
  return (evidence.sum_A + ridge * MatrixXd::Identity(n, n)).ldlt().solve(evidence.sum_b);
}

/// Direction by direction of the parameters' space (eigenvectors of the information): how far the windows scatter about
/// what they say together (the sandwich estimator: H. White, Econometrica 48, 1980), and whether that is enough.
Belief believe(const Evidence& evidence, const BeamCalibrationOptions& options) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(evidence.sum_A);
  const MatrixXd& Q = solver.eigenvectors();
  const VectorXd y = posterior_mean(evidence, 1);
  const Eigen::Index n = y.size();
  VectorXd scatter = VectorXd::Zero(n);
  for (std::size_t w = 0; w < evidence.A.size(); ++w) {
    scatter += (Q.transpose() * (evidence.b[w] - evidence.A[w] * y)).cwiseAbs2();
  }
  const double windows = double(evidence.A.size());
  if (windows > 1) scatter *= windows / (windows - 1);
  Belief belief;
  VectorXd in_directions = VectorXd::Zero(n), variances(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double information = std::max(solver.eigenvalues()[j], 0.0);
    const double found = Q.col(j).dot(y);
    const double model_error = options.model_error * windows;
    const double deviation =
        std::sqrt(std::max(scatter[j], information) + model_error * model_error) / (information + 1);
    const double posterior = std::max(deviation * deviation, 1 / (information + 1));
    const bool believed = windows > 1 && std::abs(found) > options.significance * deviation;
    if (believed) ++belief.believed, in_directions[j] = found;
    variances[j] = std::min(1.0, believed ? posterior : posterior + found * found);
  }
  belief.y = Q * in_directions;
  belief.covariance = Q * variances.asDiagonal() * Q.transpose();
  return belief;
}

BeamFit fit_of(const std::vector<BeamWindow>& windows, std::size_t rings) {
  VectorXd residual = VectorXd::Zero(Eigen::Index(rings)), weight = residual;
  std::vector<double> thickness;
  for (const BeamWindow& w : windows) {
    residual += w.residual, weight += w.weight;
    if (w.thickness > 0) thickness.push_back(w.thickness);
  }
  BeamFit fit;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    fit.residual.push_back(weight[k] > 0 ? residual[k] / weight[k] : std::numeric_limits<double>::quiet_NaN());
  }
  if (!thickness.empty()) fit.thickness = median(thickness);
  return fit;
}

}  // namespace

BeamEstimate prior_beams(std::size_t rings, double bright, const BeamCalibrationOptions& options) {
  constexpr double kDegree = std::numbers::pi / 180;
  BeamEstimate prior;
  prior.model.range.assign(rings, 0.0), prior.model.elevation.assign(rings, 0.0);
  prior.model.bright = bright;
  const auto n = Eigen::Index(rings);
  VectorXd deviation(2 * n + 5);
  deviation.head(n).setConstant(options.sigma_range);
  deviation.segment(n, n).setConstant(options.sigma_elevation * kDegree);
  deviation[2 * n] = options.sigma_walk;
  deviation.tail<4>().setConstant(options.sigma_encoder * kDegree);
  prior.covariance = deviation.cwiseAbs2().asDiagonal();
  return prior;
}

BeamCalibration estimate_beams(KeyframeWindows windows, const BeamEstimate& prior,
                               const BeamCalibrationOptions& options, const CalibrationProgress& progress) {
  const std::size_t rings = prior.model.beams();
  const PriorUnits units{parameters_of(prior.model, rings), prior.covariance.llt().matrixL()};
  BeamCalibration result;
  result.beams = prior;
  result.windows = windows.size();
  for (const auto& window : windows) result.keyframes += window.size();
  result.directions = std::size_t(units.mean.size());
  VectorXd theta = units.mean;
  for (int i = 0; i < options.iterations; ++i) {
    const std::vector<BeamWindow> linear = linearize(windows, with_parameters(prior.model, theta), rings, options);
    if (i == 0) result.before = fit_of(linear, rings);
    const Evidence evidence = evidence_of(linear, units, theta);
    VectorXd y = posterior_mean(evidence, 1 + options.model_error * double(windows.size()));
    if (i + kStrict >= options.iterations) {
      const Belief belief = believe(evidence, options);
      y = belief.y, result.believed = belief.believed;
      result.beams.covariance = units.spread * belief.covariance * units.spread.transpose();
    }
    const VectorXd step = units.mean + units.spread * y - theta;
    theta += step;
    for (std::size_t w = 0; w < windows.size(); ++w) follow(windows[w], linear[w], step);
    if (progress) progress(i + 1, options.iterations);
  }
  result.beams.model = with_parameters(prior.model, theta);
  const std::vector<BeamWindow> last = linearize(windows, result.beams.model, rings, options);
  result.after = fit_of(last, rings);
  for (const BeamWindow& window : last) result.rows += window.rows;
  return result;
}

}  // namespace tilth
