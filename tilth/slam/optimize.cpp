#include <array>
#include <ceres/ceres.h>
#include <memory>

#include <tilth/core/symmetric6.hpp>
#include <tilth/slam/optimize.hpp>

namespace tilth {
namespace {

// Where a pose is kept while Ceres moves it: quaternion x y z w, then translation.
using Parameters = std::array<double, 7>;
constexpr int kRotationSize = 4, kTranslationSize = 3;

Parameters parameters_of(const Pose& pose) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  const Eigen::Vector3d t = pose.translation();
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

Pose pose_of(const Parameters& p) {
  return Eigen::Translation3d(p[4], p[5], p[6]) * Eigen::Quaterniond(p[3], p[0], p[1], p[2]).normalized();
}

// W with W^T W = information, also where some directions have none.
Matrix6d square_root(const Matrix6d& information) {
  const Eigen6d eigen = eigen_of(information);
  return eigen.values.cwiseMax(0).cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
}

// The error of a constraint, whitened: twice the vector part of the quaternion that is left, which is the rotation to
// the second order, and the translation that is left.
class ConstraintError {
 public:
  explicit ConstraintError(const Constraint& c)
      : q_to_from_(Eigen::Quaterniond(c.T_from_to.linear()).normalized().conjugate()),
        t_from_to_(c.T_from_to.translation()),
        whitening_(square_root(c.information)) {}

  template <class T>
  bool operator()(const T* q_from, const T* t_from, const T* q_to, const T* t_to, T* residuals) const {
    using Quaternion = Eigen::Quaternion<T>;
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Quaternion> q_world_from(q_from), q_world_to(q_to);
    const Eigen::Map<const Vector3> p_from(t_from), p_to(t_to);
    const Quaternion q_back = q_world_from.conjugate(), q_measured_back = q_to_from_.template cast<T>();
    const Quaternion left = q_measured_back * (q_back * q_world_to);
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() = T(left.w() < T(0) ? -2 : 2) * left.vec();
    error.template tail<3>() = q_measured_back * (q_back * (p_to - p_from) - t_from_to_.template cast<T>());
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residuals} = whitening_.template cast<T>() * error;
    return true;
  }

 private:
  Eigen::Quaterniond q_to_from_;
  Eigen::Vector3d t_from_to_;
  Matrix6d whitening_;
};

class GraphProblem {
 public:
  GraphProblem(const PoseGraph& graph, double kernel_width) {
    for (const Pose& pose : graph.poses) parameters_.push_back(parameters_of(pose));
    for (Parameters& p : parameters_) {
      problem_.AddParameterBlock(p.data(), kRotationSize, new ceres::EigenQuaternionManifold);
      problem_.AddParameterBlock(p.data() + kRotationSize, kTranslationSize);
    }
    for (const Constraint& c : graph.constraints) add(c, kernel_width);
    problem_.SetParameterBlockConstant(parameters_[0].data());
    problem_.SetParameterBlockConstant(parameters_[0].data() + kRotationSize);
  }

  OptimizedGraph solve(int max_iterations) {
    ceres::Solver::Options options;
    options.max_num_iterations = max_iterations;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // same bits whatever the number of threads
    options.num_threads = 1;
    options.function_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    OptimizedGraph result{.converged = summary.termination_type == ceres::CONVERGENCE,
                          .iterations = int(summary.iterations.size())};
    for (const Parameters& p : parameters_) result.poses.push_back(pose_of(p));
    return result;
  }

 private:
  void add(const Constraint& c, double kernel_width) {
    using Cost = ceres::AutoDiffCostFunction<ConstraintError, 6, kRotationSize, kTranslationSize, kRotationSize,
                                             kTranslationSize>;
    double* const from = parameters_[c.from].data();
    double* const to = parameters_[c.to].data();
    ceres::LossFunction* const loss = c.closure ? new ceres::CauchyLoss(kernel_width) : nullptr;
    problem_.AddResidualBlock(new Cost(new ConstraintError(c)), loss, from, from + kRotationSize, to,
                              to + kRotationSize);
  }

  std::vector<Parameters> parameters_;
  ceres::Problem problem_;  // owns costs, losses and manifolds
};

}  // namespace

OptimizedGraph optimize(const PoseGraph& graph, const GraphOptions& options) {
  for (const Constraint& c : graph.constraints) {
    if (std::max(c.from, c.to) >= graph.poses.size() || c.from == c.to)
      throw Error("constraint " + std::to_string(c.from) + " - " + std::to_string(c.to),
                  "joins no two of the graph's " + std::to_string(graph.poses.size()) + " poses");
  }
  if (graph.constraints.empty()) return {.poses = graph.poses, .converged = true};
  return GraphProblem(graph, options.kernel_width).solve(options.max_iterations);
}

Vector6d error_of(const Constraint& constraint, const Pose& T_world_from, const Pose& T_world_to) {
  return log(constraint.T_from_to.inverse() * (T_world_from.inverse() * T_world_to));
}

double squared_error(const Constraint& constraint, const Pose& T_world_from, const Pose& T_world_to) {
  const Vector6d error = error_of(constraint, T_world_from, T_world_to);
  return error.dot(constraint.information * error);
}

}  // namespace tilth
