#include <cmath>

#include <Eigen/Eigenvalues>

#include <tilth/slam/loop_closure.hpp>

namespace tilth {
namespace {

// Unit: metres that a typical point moves, for rotations as well.
Vector6d arc_scale(const SurfacePatches& patches) {
  double squares = 0;
  for (const SurfacePatch& patch : patches) squares += patch.mean.squaredNorm();
  Vector6d scale = Vector6d::Ones();
  scale.head<3>().setConstant(1 / std::max(0.1, std::sqrt(squares / std::max(1.0, double(patches.size())))));
  return scale;
}

// The registration's information, no more than `noise` allows, and none along degenerate directions.
void weigh(const Matrix6d& information, const Vector6d& scale, const VerifyOptions& options, LoopClosure& closure) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scale.asDiagonal() * information * scale.asDiagonal());
  const double weakest = options.degeneracy_ratio * eigen.eigenvalues()[5];
  Vector6d weights = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const double strength = eigen.eigenvalues()[i];
    if (!(strength > 0) || strength < weakest)
      ++closure.degenerate_directions;
    else
      weights[i] = 1 / (options.variance_scale / strength + options.noise * options.noise);
  }
  const Matrix6d back = scale.cwiseInverse().asDiagonal() * eigen.eigenvectors();
  closure.constraint.information = back * weights.asDiagonal() * back.transpose();
}

// Least determined direction of translation first.
Eigen::Matrix3d translation_axes(const Matrix6d& information) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(information.bottomRightCorner<3, 3>()).eigenvectors();
}

// Both directions; the lesser counts.
Overlap mutual_overlap(const Submap& from, const Submap& to, const Pose& T_from_to, const Eigen::Matrix3d& axes,
                       const SubmapOptions& options) {
  const FacingAxes facing{axes};
  const Overlap forth = overlap_of(to.patches(), T_from_to, from.fine(), facing, options);
  const Overlap back =
      overlap_of(moved(from.patches(), T_from_to.inverse()), Pose::Identity(), to.fine(), facing, options);
  return {std::min(forth.share, back.share), std::min(forth.least_share, back.least_share),
          std::max(forth.fitness, back.fitness)};
}

// Whether the submaps fit as well elsewhere: poses along `axis` (in the query's frame) are tried as far as odometry
// leaves them open.
bool fits_elsewhere(const LoopClosure& closure, const Submap& from, const Submap& to, const Expectation& expected,
                    const VerifyOptions& options) {
  const Pose& T_found = closure.constraint.T_from_to;
  const Eigen::Matrix3d axes = translation_axes(closure.constraint.information);
  const int steps = int(std::ceil(2 * expected.translation / options.ambiguity_step));
  for (int i = -steps; i <= steps; ++i) {
    const Eigen::Vector3d shift = axes.col(0) * (i * options.ambiguity_step);
    const Pose T_shifted = T_found * Eigen::Translation3d(shift);
    if (i == 0 || !agrees(T_shifted, expected)) continue;
    const Pose T_other = refine(to.patches(), from, T_shifted, options.submap).T_target_source;
    const double apart = (T_found.translation() - T_other.translation()).norm();
    if (apart < options.ambiguity_step / 2 || !agrees(T_other, expected)) continue;
    const Overlap overlap = overlap_of(to.patches(), T_other, from.fine(), {axes}, options.submap);
    if (overlap.least_share > options.ambiguity * closure.facing_overlap) return true;
  }
  return false;
}

// A direction that is not determined at all is left open by the constraint, which is enough where odometry tells what
// it is, but not where only the likeness of two places does.
bool is_ambiguous(const LoopClosure& closure, const Submap& from, const Submap& to, const Expectation& expected,
                  const VerifyOptions& options) {
  if (closure.degenerate_directions > 0) return closure.found_by == FoundBy::context;
  return fits_elsewhere(closure, from, to, expected, options);
}

Verdict judge(const LoopClosure& closure, const Expectation& expected, const VerifyOptions& options) {
  if (closure.overlap < options.min_overlap || closure.facing_overlap < options.min_facing_overlap)
    return Verdict::little_overlap;
  if (closure.fitness > options.max_fitness) return Verdict::poor_fitness;
  return agrees(closure.constraint.T_from_to, expected) ? Verdict::accepted : Verdict::against_odometry;
}

}  // namespace

std::span<const std::string_view> names_of(Verdict) {
  static constexpr std::array<std::string_view, 8> names{"accepted",     "not_registered",   "little_overlap",
                                                         "poor_fitness", "against_odometry", "ambiguous",
                                                         "unconfirmed",  "outvoted"};
  return names;
}

std::span<const std::string_view> names_of(FoundBy) {
  static constexpr std::array<std::string_view, 2> names{"radius", "context"};
  return names;
}

bool agrees(const Pose& T_from_to, const Expectation& expected) {
  const Pose error = expected.T_from_to.inverse() * T_from_to;
  return error.translation().norm() <= expected.translation && angle_of(error) <= expected.rotation;
}

LoopClosure verify(const LoopCandidate& candidate, const Submap& from, const Submap& to, const Expectation& expected,
                   const VerifyOptions& options) {
  LoopClosure closure{.found_by = candidate.found_by};
  closure.constraint = {candidate.from, candidate.to, candidate.T_from_to, Matrix6d::Zero(), true};
  const AlignResult found = register_submap(to.patches(), from, candidate.T_from_to, options.submap);
  if (!found.converged) return closure;
  closure.constraint.T_from_to = found.T_target_source;
  weigh(found.information, arc_scale(to.patches()), options, closure);
  const Overlap overlap =
      mutual_overlap(from, to, found.T_target_source, translation_axes(found.information), options.submap);
  closure.overlap = overlap.share;
  closure.facing_overlap = overlap.least_share;
  closure.fitness = overlap.fitness;
  closure.verdict = judge(closure, expected, options);
  if (closure.verdict == Verdict::accepted && is_ambiguous(closure, from, to, expected, options))
    closure.verdict = Verdict::ambiguous;
  return closure;
}

}  // namespace tilth
