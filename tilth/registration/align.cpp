#include <cmath>

#include <Eigen/Cholesky>

#include <tilth/core/symmetric6.hpp>
#include <tilth/registration/align.hpp>

namespace tilth {
namespace {

bool is_active(Freedom active, int direction) {
  const bool is_level = direction == 0 || direction == 1 || direction == 5;
  return active == Freedom::all || is_level == (active == Freedom::roll_pitch_z);
}

// J^T J and J^T e of the active directions; the others are determined, and stand still.
LinearSystem restricted(LinearSystem system, const AlignOptions& options) {
  for (int i = 0; i < 6; ++i) {
    if (is_active(options.active, i)) continue;
    system.H.row(i).setZero();
    system.H.col(i).setZero();
    system.H(i, i) = 1 + options.min_information;
    system.b[i] = 0;
  }
  return system;
}

// One Gauss-Newton step, or damped (Levenberg-Marquardt); false where the system has no solution.
bool solve(const LinearSystem& system, double damping, Vector6d& step) {
  Matrix6d H = system.H;
  H.diagonal() += damping * H.diagonal();
  const Eigen::LDLT<Matrix6d> factor(H);
  step = factor.solve(-system.b);
  return factor.info() == Eigen::Success && step.allFinite();
}

// Holds the directions whose eigenvalue, of rotations in rad and translations in m, is below `min_information`.
void hold_weak_directions(const LinearSystem& system, double min_information, AlignState& state) {
  const Eigen6d eigen = eigen_of(system.H);
  const Vector6d kept = (eigen.values.array() >= min_information).cast<double>();
  state.movable = eigen.vectors * kept.asDiagonal() * eigen.vectors.transpose();
  state.held_directions = 6 - int(kept.sum());
}

}  // namespace

StepOutcome gauss_newton_step(const AlignOptions& options, AlignState& state, AlignResult& result) {
  const LinearSystem system = restricted(state.system, options);
  Vector6d step;
  if (system.matches < std::size_t(options.min_matches) || !solve(system, options.damping, step))
    return StepOutcome::failed;
  if (options.min_information > 0) {
    if (state.steps == 0) hold_weak_directions(system, options.min_information, state);
    step = state.movable * step;
  }
  step *= options.step_ratio;
  ++state.steps;
  result.T_target_source = retract(result.T_target_source, step);
  const double error = state.system.error / double(state.system.matches);
  const double change = std::abs(error - state.last_error);
  state.last_error = error;
  const bool still =
      step.head<3>().norm() < options.rotation_epsilon && step.tail<3>().norm() < options.transformation_epsilon;
  return still || change <= options.fitness_epsilon * error ? StepOutcome::stands_still : StepOutcome::moved;
}

Vector6d arc_scale(const LinearSystem& system) {
  const double range = std::sqrt(system.squared_range / std::max<double>(1.0, double(system.matches)));
  Vector6d scale = Vector6d::Ones();
  scale.head<3>().setConstant(range > 0 ? 1 / range : 1.0);
  return scale;
}

void diagnose(const LinearSystem& system, double degeneracy_ratio, AlignResult& result) {
  result.matches = system.matches;
  result.weight = system.weight;
  result.error = system.error;
  result.information = system.H;
  const Vector6d scale = arc_scale(system);
  const Eigen6d eigen = eigen_of(scale.asDiagonal() * system.H * scale.asDiagonal());
  const double strongest = eigen.values[5];
  const double weakest = std::max(degeneracy_ratio * strongest, 1e-9);
  result.degenerate_directions = int((eigen.values.array() < weakest).count());
  const double freedom = std::max(1.0, 3.0 * double(system.matches) - 6.0);
  const double variance = system.matches == 0 ? 1.0 : std::max(2 * system.error / freedom, 1e-12);
  const Vector6d inverse = eigen.values.cwiseMax(1e-9).cwiseInverse();
  const Matrix6d scaled = eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
  result.covariance = variance * (scale.asDiagonal() * scaled * scale.asDiagonal());
}

AlignResult unmatched(const Pose& T) {
  AlignResult result{.T_target_source = T};
  diagnose(LinearSystem(), AlignOptions().degeneracy_ratio, result);
  return result;
}

}  // namespace tilth
