// The one loop of every registration, Gauss-Newton: associate, linearise, solve, until the pose or the error stands
// still.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/registration/align_result.hpp>
#include <tilth/registration/residual.hpp>
#include <tilth/registration/robust_kernel.hpp>

namespace tilth {

/// Which of a pose's degrees of freedom, about and along the axes of the source, a registration may change.
enum class Freedom { all, roll_pitch_z, yaw_x_y };
inline std::span<const std::string_view> names_of(Freedom) {
  static constexpr std::array<std::string_view, 3> names{"all", "roll_pitch_z", "yaw_x_y"};
  return names;
}

struct AlignOptions {
  int max_iterations = 200;
  int inner_iterations = 1;
  double transformation_epsilon = 1e-6;
  double rotation_epsilon = 1e-6;
  double fitness_epsilon = 1e-6;
  Kernel kernel = Kernel::none;
  double kernel_width = 1.0;
  double damping = 0.0;
  double min_information = 0.0;
  double degeneracy_ratio = 1e-3;
  int min_matches = 20;
  Freedom active = Freedom::all;
  double step_ratio = 1.0;
};

template <class V>
void visit(AlignOptions& o, V&& v) {
  v("max_iterations", o.max_iterations, Bounds{1, 10000}, "[-] associations at most");
  v("inner_iterations", o.inner_iterations, Bounds{1, 1000}, "[-] steps at most on the same pairs", kAdvanced);
  v("transformation_epsilon", o.transformation_epsilon, Bounds{0, 1}, "[m] stop when a step is smaller", kAdvanced);
  v("rotation_epsilon", o.rotation_epsilon, Bounds{0, 1}, "[rad] stop when a step is smaller", kAdvanced);
  v("fitness_epsilon", o.fitness_epsilon, Bounds{0, 1}, "[-] stop when the mean error changes by a smaller share",
    kAdvanced);
  v("kernel", o.kernel, "[-] robust kernel on each pair");
  v("kernel_width", o.kernel_width, Bounds{1e-9, 1e9}, "[-] residual at which the kernel begins to act");
  v("damping", o.damping, Bounds{0, 1e9},
    "[-] share of the diagonal of J^T J that is added to it (Levenberg, Marquardt)", kAdvanced);
  v("min_information", o.min_information, Bounds{0, 1e12},
    "[-] eigenvalue of the first J^T J below which a direction keeps the predicted pose; 0: all directions move",
    kAdvanced);
  v("degeneracy_ratio", o.degeneracy_ratio, Bounds{0, 1},
    "[-] a direction with less information than this share of the best one is degenerate", kAdvanced);
  v("min_matches", o.min_matches, Bounds{6, 1e9}, "[-] pairs below which the predicted pose is kept", kAdvanced);
  v("active", o.active, "[-] degrees of freedom that change", kAdvanced);
  v("step_ratio", o.step_ratio, Bounds{1e-6, 1}, "[-] of the Gauss-Newton step that is taken", kAdvanced);
}

/// What a registration carries from one step to the next.
struct AlignState {
  LinearSystem system;                      ///< at the pose before the next step
  Matrix6d movable = Matrix6d::Identity();  ///< projects a step onto the directions that may move
  int held_directions = 0;                  ///< the others
  double last_error = -1;                   ///< mean over the pairs, one step ago
  int steps = 0;
};

enum class StepOutcome { moved, stands_still, failed };

/// One Gauss-Newton step of result.T_target_source on state.system; failed where there are too few pairs or no
/// solution.
StepOutcome gauss_newton_step(const AlignOptions& options, AlignState& state, AlignResult& result);

/// What rotations [rad] and translations [m] are divided by to compare: rotations then count in units of the arc by
/// which they move a typical point of the pairs.
Vector6d arc_scale(const LinearSystem& system);

/// Fills information, covariance and degenerate directions from the last system.
void diagnose(const LinearSystem& system, double degeneracy_ratio, AlignResult& result);

/// Where there is nothing to match with: T stands, not converged, and nothing is known of it.
AlignResult unmatched(const Pose& T);

/// Moves T_init until the pairs of all `associate(T) -> vector of Residual` agree. The pairs, and whatever they derive
/// from T, are made anew in every iteration. Directions of too little information (Zhang, Kaess and Singh 2016) stay at
/// T_init if options.min_information says so. Too few pairs: T_init comes back, not converged.
template <class... Associations>
AlignResult align(const Pose& T_init, const AlignOptions& options, const Associations&... associate) {
  AlignResult result{.T_target_source = T_init};
  const RobustKernel kernel{options.kernel, options.kernel_width};
  AlignState state;
  StepOutcome outcome = StepOutcome::moved;
  while (result.iterations < options.max_iterations && !result.converged && outcome != StepOutcome::failed) {
    const std::tuple pairs{associate(result.T_target_source)...};
    ++result.iterations;
    outcome = StepOutcome::moved;
    for (int inner = 0; inner < options.inner_iterations && outcome == StepOutcome::moved; ++inner) {
      state.system = LinearSystem();
      const auto add = [&](const auto&... p) {
        (accumulate(state.system, std::span(p.data(), p.size()), result.T_target_source, kernel), ...);
      };
      std::apply(add, pairs);
      outcome = gauss_newton_step(options, state, result);
      result.converged = outcome == StepOutcome::stands_still && inner == 0;
    }
  }
  if (outcome == StepOutcome::failed) result.T_target_source = T_init;
  diagnose(state.system, options.degeneracy_ratio, result);
  if (options.min_information > 0 && state.steps > 0) result.degenerate_directions = state.held_directions;
  return result;
}

}  // namespace tilth
