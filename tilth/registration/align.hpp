// The one loop of every registration: associate, linearise, solve, until the pose or the error stands still.
#pragma once

#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/registration/align_result.hpp>
#include <tilth/registration/residual.hpp>
#include <tilth/registration/robust_kernel.hpp>

namespace tilth {

struct AlignOptions {
  int max_iterations = 200;
  double transformation_epsilon = 1e-6;
  double fitness_epsilon = 1e-6;
  Kernel kernel = Kernel::none;
  double kernel_width = 1.0;
  double degeneracy_ratio = 1e-3;
  int min_matches = 20;
};

template <class V>
void visit(AlignOptions& o, V&& v) {
  v("max_iterations", o.max_iterations, Bounds{1, 10000}, "[-] associations at most");
  v("transformation_epsilon", o.transformation_epsilon, Bounds{0, 1}, "[rad, m] stop when a step is smaller");
  v("fitness_epsilon", o.fitness_epsilon, Bounds{0, 1}, "[-] stop when the mean error changes by a smaller share");
  v("kernel", o.kernel, "[-] robust kernel on each pair");
  v("kernel_width", o.kernel_width, Bounds{1e-9, 1e9}, "[-] residual at which the kernel begins to act");
  v("degeneracy_ratio", o.degeneracy_ratio, Bounds{0, 1},
    "[-] a direction with less information than this share of the best one is degenerate");
  v("min_matches", o.min_matches, Bounds{6, 1e9}, "[-] pairs below which the predicted pose is kept");
}

/// Normal equations H x = -b of all pairs, and what else one pass over them gives.
struct LinearSystem {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double error = 0.0;          ///< 1/2 sum of weighted squared residuals
  double squared_range = 0.0;  ///< [m^2] sum over the source points
  std::size_t matches = 0;
};

template <Residual R>
void accumulate(LinearSystem& system, std::span<const R> residuals, const Pose& T, const RobustKernel& kernel) {
  for (const R& r : residuals) {
    const auto e = r.residual(T).eval();
    const auto J = r.jacobian(T).eval();
    const double w = kernel.weight(e.squaredNorm());
    system.H.noalias() += w * (J.transpose() * J);
    system.b.noalias() += w * (J.transpose() * e);
    system.error += 0.5 * w * e.squaredNorm();
    system.squared_range += r.source.squaredNorm();
  }
  system.matches += residuals.size();
}

/// One Gauss-Newton step on `system`; false where the system has no solution.
bool solve(const LinearSystem& system, Vector6d& step);

/// Fills information, covariance and degenerate directions from the last system.
void diagnose(const LinearSystem& system, double degeneracy_ratio, AlignResult& result);

/// Moves T_init until the pairs of all `associate(T) -> vector of Residual` agree. The pairs, and whatever they derive
/// from T, are made anew in every iteration. Too few pairs: T_init comes back, not converged.
template <class... Associations>
AlignResult align(const Pose& T_init, const AlignOptions& options, const Associations&... associate) {
  AlignResult result{.T_target_source = T_init};
  const RobustKernel kernel{options.kernel, options.kernel_width};
  LinearSystem system;
  double last_error = -1;
  while (result.iterations < options.max_iterations && !result.converged) {
    system = LinearSystem();
    const auto add = [&](const auto& pairs) {
      accumulate(system, std::span(pairs.data(), pairs.size()), result.T_target_source, kernel);
    };
    (add(associate(result.T_target_source)), ...);
    ++result.iterations;
    Vector6d step;
    if (system.matches < std::size_t(options.min_matches) || !solve(system, step)) {
      result.T_target_source = T_init;
      break;
    }
    result.T_target_source = retract(result.T_target_source, step);
    const double error = system.error / double(system.matches);
    const bool still = step.head<3>().norm() < options.transformation_epsilon &&
                       step.tail<3>().norm() < options.transformation_epsilon;
    result.converged = still || std::abs(error - last_error) <= options.fitness_epsilon * error;
    last_error = error;
  }
  diagnose(system, options.degeneracy_ratio, result);
  return result;
}

}  // namespace tilth
