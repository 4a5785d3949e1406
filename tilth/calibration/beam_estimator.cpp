#include <numbers>

#include <tilth/calibration/beam_estimator.hpp>
#include <tilth/calibration/beam_evidence.hpp>
#include <tilth/core/parallel.hpp>

namespace tilth {
namespace {

using Eigen::VectorXd;

constexpr int kStrict = 2;  // last iterations, in which only what is believed is applied

std::vector<BeamWindow> linearize(const KeyframeWindows& windows, const BeamModel& beams, std::size_t rings,
                                  const BeamCalibrationOptions& options) {
  std::vector<BeamWindow> result(windows.size());
  parallel_for(windows.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[i] = beam_window(windows[i], beams, rings, options);
  });
  return result;
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

BeamEstimate completed(const BeamEstimate& known, std::size_t rings, const BeamCalibrationOptions& options) {
  constexpr double kLeast = 1e-6;  // of the variances of any sensor, so that there are none of 0
  const std::size_t n = known.model.beams() > 0 ? known.model.beams() : rings;
  BeamEstimate prior = prior_beams(n, known.model.bright, options);
  prior.model = with_parameters(known.model, parameters_of(known.model, n));
  const Eigen::Index given = known.covariance.rows();
  const Eigen::VectorXd least = kLeast * prior.covariance.diagonal();
  prior.covariance.bottomRightCorner(given, given) = known.covariance;
  prior.covariance.diagonal() += least;
  return prior;
}

BeamCalibration estimate_beams(KeyframeWindows windows, const BeamEstimate& prior,
                               const BeamCalibrationOptions& options, const CalibrationProgress& progress) {
  const std::size_t rings = prior.model.beams();
  const PriorUnits units(prior);
  BeamCalibration result;
  result.beams = prior;
  result.windows = windows.size();
  for (const auto& window : windows) result.keyframes += window.size();
  result.directions = std::size_t(units.mean.size());
  VectorXd theta = units.mean;
  for (int i = 0; i < options.iterations; ++i) {
    const std::vector<BeamWindow> linear = linearize(windows, with_parameters(prior.model, theta), rings, options);
    if (i == 0) result.before = fit_of(linear);
    std::vector<WindowEvidence> evidence;
    for (const BeamWindow& window : linear) evidence.push_back(evidence_of(window, units, theta));
    VectorXd y = posterior_mean(evidence, 1 + options.model_error * double(windows.size()));
    if (i + kStrict >= options.iterations) {
      const BeamBelief belief = believe(evidence, options);
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
  result.after = fit_of(last);
  for (const BeamWindow& window : last) result.rows += window.rows;
  return result;
}

}  // namespace tilth
