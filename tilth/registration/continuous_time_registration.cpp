#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <tilth/core/symmetric6.hpp>
#include <tilth/registration/continuous_time_registration.hpp>
#include <tilth/registration/continuous_time_system.hpp>
#include <tilth/registration/vibration.hpp>

namespace tilth {
namespace {

constexpr double kWhollyTrusted = 1.5;  // times the share below which a direction is degenerate

// How much the pairs are to be believed along a direction with this share of the strongest one's information.
double trust(double ratio, double degeneracy_ratio) {
  return std::clamp((ratio / degeneracy_ratio - 1.0) / (kWhollyTrusted - 1.0), 0.0, 1.0);
}

// Eigenvalues of the information matrix tell what is degenerate (docs/method.md, 15), as the pairs would determine it
// if all were right, which they may not be yet: keep * x is the part of a motion x of the pose that they are trusted
// with.
Matrix6d trusted_part(const PatchPairs& pairs, const Pose& T_map_lidar, const ContinuousTimeOptions& options) {
  const LinearSystem system = unweighted(pairs, T_map_lidar);
  const Vector6d scale = arc_scale(system);
  const Eigen6d eigen = eigen_of(scale.asDiagonal() * system.H * scale.asDiagonal());
  const Vector6d ratios = eigen.values / eigen.values[5];
  const Vector6d kept = ratios.unaryExpr([&](double ratio) { return trust(ratio, options.degeneracy_ratio); });
  if ((kept.array() == 1.0).all()) return Matrix6d::Identity();
  return scale.asDiagonal() * eigen.vectors * kept.asDiagonal() * eigen.vectors.transpose() *
         scale.cwiseInverse().asDiagonal();
}

// Along directions that the pairs hardly determine, slightly wrong normals and rings, which travel with the sensor, say
// more than the surfaces do. There, in what `keep` does not keep, the pairs are not heard.
void keep_only(const Matrix6d& keep, SegmentSystems& parts) {
  Matrix12d keep_both = Matrix12d::Zero();
  keep_both.topLeftCorner<6, 6>() = keep_both.bottomRightCorner<6, 6>() = keep;
  for (ContinuousTimeSystem& part : parts) {
    part.H = keep_both.transpose() * part.H * keep_both;
    part.b = keep_both.transpose() * part.b;
  }
}

// Before, pairs are yet to be found.
bool narrow(const MotionState& state, const ContinuousTimeOptions& options) {
  return state.kernel_width <= options.kernel_width;
}

struct Linearized {
  SegmentSystems parts;
  ContinuousTimeSystem whole = {};
  Matrix6d lost = Matrix6d::Zero();  // * x is the part of a motion x of the pose that the pairs are not heard about
};

void add_priors(const PatchPairs& pairs, const MotionPrior& prior, const ContinuousTimeOptions& options,
                const MotionState& state, Linearized& at_state) {
  if (prior.known && narrow(state, options)) {
    const Matrix6d keep = trusted_part(pairs, state.T_map_lidar, options);
    if (!keep.isIdentity(0)) {
      keep_only(keep, at_state.parts);
      at_state.whole = sum_of(at_state.parts);
      at_state.lost = Matrix6d::Identity() - keep;
      add_steady_prior(prior, options, at_state.lost, state, at_state.whole);
    }
  }
  if (prior.known) add_pose_prior(prior, options, state, at_state.whole);
  add_claim(prior, state, at_state.whole);
  add_velocity_prior(prior, options, state, at_state.whole);
}

bool step_steady(const ContinuousTimeSystem& system, Vector12d& step) {
  const Eigen::LDLT<Matrix12d> factor(system.H);
  step = factor.solve(-system.b);
  return factor.info() == Eigen::Success && step.allFinite();
}

// Covariance (docs/method.md, 16): squared residuals are less than their variances promise, which are wide on purpose:
// the scale of the covariance.
double residual_scale(const PatchPairs& pairs, double error) {
  constexpr double kState = 12, kLeast = 0.05;
  const double freedom = double(pairs.flat.size()) + 3 * double(pairs.shapes.size()) - kState;
  return std::max(kLeast, 2 * error / std::max(1.0, freedom));
}

}  // namespace

ScanPrior scan_prior(const MotionPrior& motion, double middle, const ContinuousTimeOptions& options) {
  if (!motion.known || !(middle > 0) || motion.vibration.none()) return {motion};
  return {motion, knot_precision(2 * middle, options.vibration)};
}

bool gauss_newton_step(const PatchPairs& pairs, const ScanPrior& prior, const ContinuousTimeOptions& options,
                       MotionState& state, ContinuousTimeAlignment& result) {
  Linearized at_state{.parts = linearize(pairs, state)};
  at_state.whole = sum_of(at_state.parts);
  ++result.pose.iterations;
  diagnose(at_state.whole.pose, options.degeneracy_ratio, result.pose);
  if (pairs.size() < std::size_t(options.min_matches)) return false;
  add_priors(pairs, prior.motion, options, state, at_state);
  const ContinuousTimeSystem& system = at_state.whole;
  const double scale = residual_scale(pairs, result.pose.error);
  VibrationPrior vibration;
  std::optional<VibrationFactor> vibration_factor;
  Vector12d step;
  if (!prior.knots || !narrow(state, options)) {
    if (!step_steady(system, step)) return false;
  } else {
    const VibratingScan scan{prior.motion.vibration_gain, scale, *prior.knots};
    vibration = vibration_prior(prior.motion.vibration, prior.motion.vibration_mean, scan, options.vibration);
    const VibrationSystem whole = vibration_system(at_state.parts, system, vibration, state);
    vibration_factor = factor_of(whole);
    if (!step_with_vibration(whole, *vibration_factor, step, state.motion.vibration)) return false;
  }
  state.T_map_lidar = retract(state.T_map_lidar, step.head<6>());
  state.motion.velocity += step.tail<6>();
  state.motion.acceleration = acceleration_in(prior.motion, options, state);
  result.pose.converged =
      step.head<3>().norm() < options.rotation_epsilon && step.segment<3>(3).norm() < options.translation_epsilon;
  if (!result.pose.converged && result.pose.iterations < options.max_iterations) return true;
  if (vibration_factor) result.evidence = evidence_of(*vibration_factor, vibration, state.motion.vibration);
  const Matrix6d covariance =
      vibration_factor ? covariance_in_middle(*vibration_factor) : Matrix6d(system.H.inverse().topLeftCorner<6, 6>());
  const Matrix6d astray = steady_shift(prior.motion, options) * at_state.lost;  // no residual tells of it
  result.covariance = scale * covariance + astray * astray.transpose();
  result.dead_reckoned = at_state.lost;
  result.surfaces_seen_at = pairs.seen_at_sum / double(pairs.size());
  return true;
}

}  // namespace tilth
