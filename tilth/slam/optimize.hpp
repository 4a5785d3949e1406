// The poses of a graph at which its constraints agree best (Levenberg-Marquardt on the sparse normal equations, by
// Ceres). Closures, which may be wrong, are held by a robust kernel. About O(poses) for chains with few closures.
#pragma once

#include <tilth/core/options.hpp>
#include <tilth/core/pose_graph.hpp>

namespace tilth {

struct GraphOptions {
  int max_iterations = 50;
  double kernel_width = 3.0;
};

template <class V>
void visit(GraphOptions& o, V&& v) {
  v("max_iterations", o.max_iterations, Bounds{1, 10000}, "[-] of the optimiser at most");
  v("kernel_width", o.kernel_width, Bounds{1e-3, 1e9},
    "[sigma] at which the Cauchy kernel begins to act on loop closures");
}

struct OptimizedGraph {
  std::vector<Pose> poses = {};
  bool converged = false;
  int iterations = 0;
};

/// `graph` with its first pose held. A graph without constraints comes back as it is. Throws Error on a constraint
/// between poses that the graph does not have.
OptimizedGraph optimize(const PoseGraph& graph, const GraphOptions& options);

/// What a constraint leaves of the motion between two poses: log(T_from_to^-1 * T_world_from^-1 * T_world_to).
Vector6d error_of(const Constraint& constraint, const Pose& T_world_from, const Pose& T_world_to);

/// [sigma^2] e^T information e.
double squared_error(const Constraint& constraint, const Pose& T_world_from, const Pose& T_world_to);

}  // namespace tilth
