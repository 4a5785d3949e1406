#include <cmath>
#include <optional>

#include <tilth/slam/loop_closure.hpp>
#include <tilth/slam/submap_information.hpp>

namespace tilth {
namespace {

// The submaps of a candidate, and the direction of translation between them that is determined least.
struct SubmapPair {
  const Submap &from, &to;
  Eigen::Vector3d axis;
};

void measure_overlap(const SubmapPair& pair, const SubmapOptions& options, LoopClosure& closure) {
  const Pose& T_from_to = closure.constraint.T_from_to;
  const Overlap forth = overlap_of(pair.to.patches(), T_from_to, pair.from.fine(), pair.axis, options);
  const SurfacePatches seen_from_to = moved(pair.from.patches(), T_from_to.inverse());
  closure.overlap = forth.ratio;
  closure.landmarks = forth.landmarks;
  closure.fitness = forth.fitness;
  closure.back_overlap = overlap_of(seen_from_to, Pose::Identity(), pair.to.fine(), pair.axis, options).ratio;
}

// Where a registration ends that begins `shift` [m] along the weakest axis, if that is elsewhere and fits as well.
std::optional<Pose> other_fit(const LoopClosure& closure, const SubmapPair& pair, double shift,
                              const VerifyOptions& options) {
  const Pose& T_found = closure.constraint.T_from_to;
  const Pose T_shifted = T_found * Eigen::Translation3d(shift * pair.axis);
  const Pose T_other = refine(pair.to.patches(), pair.from, T_shifted, options.submap).T_target_source;
  if ((T_found.translation() - T_other.translation()).norm() < options.ambiguity_step / 2) return std::nullopt;
  const Overlap overlap = overlap_of(pair.to.patches(), T_other, pair.from.fine(), pair.axis, options.submap);
  return overlap.landmarks > options.ambiguity * closure.landmarks ? std::optional(T_other) : std::nullopt;
}

// A direction along which the submaps slide is left open by the constraint.
void leave_open_what_slides(const SubmapPair& pair, const VerifyOptions& options, LoopClosure& closure) {
  const double step = options.ambiguity_step;
  if (!other_fit(closure, pair, step, options) && !other_fit(closure, pair, -step, options)) return;
  Matrix6d across = Matrix6d::Identity();
  across.bottomRightCorner<3, 3>() -= pair.axis * pair.axis.transpose();
  closure.constraint.information = across * closure.constraint.information * across;
  closure.degenerate_directions = std::max(1, closure.degenerate_directions);
}

// Whether another pose that odometry leaves open fits as well. A direction that is not determined at all does no harm
// where odometry tells what it is, but where only the likeness of two places does.
bool is_ambiguous(const LoopClosure& closure, const SubmapPair& pair, const Expectation& expected,
                  const VerifyOptions& options) {
  if (closure.degenerate_directions > 0) return closure.found_by == FoundBy::context;
  const int steps = int(std::ceil(2 * expected.translation / options.ambiguity_step));
  for (int i = -steps; i <= steps; ++i) {
    const double shift = i * options.ambiguity_step;
    const bool tried = std::abs(i) < 2;
    if (tried || !agrees(closure.constraint.T_from_to * Eigen::Translation3d(shift * pair.axis), expected)) continue;
    const std::optional<Pose> other = other_fit(closure, pair, shift, options);
    if (other && agrees(*other, expected)) return true;
  }
  return false;
}

Verdict judge(const LoopClosure& closure, const Expectation& expected, const VerifyOptions& options) {
  if (closure.overlap < options.min_overlap || closure.back_overlap < options.min_back_overlap ||
      closure.landmarks < options.min_landmarks)
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
  static constexpr std::array<std::string_view, 3> names{"radius", "context", "map"};
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
  const SubmapInformation weighed = weighed_information(
      found.information, to.patches(), {options.degeneracy_ratio, options.noise, options.variance_scale});
  closure.constraint.information = weighed.information;
  closure.degenerate_directions = weighed.degenerate_directions;
  const SubmapPair pair{from, to, weakest_axis(found.information)};
  measure_overlap(pair, options.submap, closure);
  closure.verdict = judge(closure, expected, options);
  if (closure.verdict != Verdict::accepted) return closure;
  leave_open_what_slides(pair, options, closure);
  if (is_ambiguous(closure, pair, expected, options)) closure.verdict = Verdict::ambiguous;
  return closure;
}

}  // namespace tilth
