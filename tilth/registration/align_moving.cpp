#include <Eigen/Cholesky>

#include <tilth/registration/align.hpp>
#include <tilth/registration/align_moving.hpp>

namespace tilth {
namespace {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

// What one pair says about the pose at the middle of the scan; its point moves (time - middle) times as far with the
// velocity.
struct PairTerm {
  Matrix6d H;
  Vector6d b;
  double error;
};

PairTerm flat_term(const PatchPair& pair, const Pose& T, const RobustKernel& kernel) {
  const double residual = pair.normal_in_map.dot(pair.offset_in_map);
  const double information = 1 / pair.normal_in_map.dot(pair.joint * pair.normal_in_map);
  const double w = information * kernel.weight(residual * residual * information);
  const Eigen::Vector3d normal = T.linear().transpose() * pair.normal_in_map;
  Vector6d J;
  J << pair.point_in_lidar.cross(normal), normal;
  return {w * J * J.transpose(), w * residual * J, w * residual * residual};
}

PairTerm shape_term(const PatchPair& pair, const Pose& T, const RobustKernel& kernel) {
  const Eigen::Matrix3d information = pair.joint.inverse();
  const double squared = pair.offset_in_map.dot(information * pair.offset_in_map);
  const double weight = kernel.weight(squared);
  const Eigen::Matrix<double, 3, 6> J = point_jacobian(T, pair.point_in_lidar);
  const Eigen::Matrix<double, 6, 3> Jt = weight * J.transpose() * information;
  return {Jt * J, Jt * pair.offset_in_map, weight * squared};
}

struct MovingSystem {
  LinearSystem pose;  // of the pairs alone
  Matrix12d H = Matrix12d::Zero();
  Vector12d b = Vector12d::Zero();
};

MovingSystem linearize(const std::vector<PatchPair>& pairs, const MotionState& state) {
  MovingSystem system;
  Matrix6d H1 = Matrix6d::Zero(), H2 = Matrix6d::Zero();
  Vector6d b1 = Vector6d::Zero();
  const RobustKernel kernel{Kernel::geman_mcclure, state.kernel_width};
  for (const PatchPair& pair : pairs) {
    const double lever = double(pair.patch->time) - state.middle;
    const PairTerm term =
        pair.patch->flat ? flat_term(pair, state.T_map_lidar, kernel) : shape_term(pair, state.T_map_lidar, kernel);
    system.pose.H += term.H;
    H1 += lever * term.H;
    H2 += lever * lever * term.H;
    system.pose.b += term.b;
    b1 += lever * term.b;
    system.pose.error += 0.5 * term.error;
    system.pose.squared_range += pair.point_in_lidar.squaredNorm();
  }
  system.pose.matches = pairs.size();
  system.H << system.pose.H, H1, H1, H2;
  system.b << system.pose.b, b1;
  return system;
}

Vector6d weights_of(double rotation_sigma, double translation_sigma) {
  Vector6d weights;
  weights << Eigen::Vector3d::Constant(1 / (rotation_sigma * rotation_sigma)),
      Eigen::Vector3d::Constant(1 / (translation_sigma * translation_sigma));
  return weights;
}

// The pose is where the velocity expected leads to, give or take the accelerations that a robot is capable of.
void add_pose_prior(const MotionPrior& prior, const AlignMovingOptions& options, const MotionState& state,
                    MovingSystem& system) {
  const double half_square = 0.5 * prior.interval * prior.interval;
  const Vector6d weights = weights_of(half_square * options.angular_acceleration, half_square * options.acceleration);
  system.H.topLeftCorner<6, 6>() += weights.asDiagonal();
  system.b.head<6>() += weights.cwiseProduct(log(predicted(prior).inverse() * state.T_map_lidar));
}

// The velocity in the scan is the motion since the last scan, unless that itself has changed: then it may differ.
void add_velocity_prior(const MotionPrior& prior, const AlignMovingOptions& options, const MotionState& state,
                        MovingSystem& system) {
  const double rate = 1 / prior.interval;
  const Vector6d motion = rate * log(prior.T_map_last.inverse() * state.T_map_lidar);
  const Vector6d change = rate * (motion - prior.last_motion);
  const auto sigma = [&](double seen) {
    return 0.5 * prior.interval * (options.velocity_slack + options.velocity_share * seen);
  };
  const Vector6d weights = weights_of(sigma(change.head<3>().norm()), sigma(change.tail<3>().norm()));
  Eigen::Matrix<double, 6, 12> J;
  J << -rate * Matrix6d::Identity(), Matrix6d::Identity();
  const Eigen::Matrix<double, 12, 6> Jt = J.transpose() * weights.asDiagonal();
  system.H += Jt * J;
  system.b += Jt * (state.velocity - motion);
}

}  // namespace

MotionPrior next(const MotionPrior& prior, const MovingAlignment& alignment) {
  const Pose& T_map_last = alignment.pose.T_target_source;
  const bool known = prior.interval > 0 && alignment.pose.matches > 0;
  const Vector6d motion =
      known ? Vector6d(log(prior.T_map_last.inverse() * T_map_last) / prior.interval) : prior.last_motion;
  return {T_map_last, alignment.velocity, motion, 0.0, prior.known || known};
}

bool step_moving(const std::vector<PatchPair>& pairs, const MotionPrior& prior, const AlignMovingOptions& options,
                 MotionState& state, MovingAlignment& result) {
  MovingSystem system = linearize(pairs, state);
  ++result.pose.iterations;
  diagnose(system.pose, options.degeneracy_ratio, result.pose);
  if (pairs.size() < std::size_t(options.min_matches)) return false;
  if (prior.known) add_pose_prior(prior, options, state, system);
  add_velocity_prior(prior, options, state, system);
  const Eigen::LDLT<Matrix12d> factor(system.H);
  const Vector12d step = factor.solve(-system.b);
  if (factor.info() != Eigen::Success || !step.allFinite()) return false;
  state.T_map_lidar = retract(state.T_map_lidar, step.head<6>());
  state.velocity += step.tail<6>();
  result.pose.converged =
      step.head<3>().norm() < options.rotation_epsilon && step.segment<3>(3).norm() < options.translation_epsilon;
  return true;
}

}  // namespace tilth
