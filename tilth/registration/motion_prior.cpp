#include <tilth/registration/motion_prior.hpp>

namespace tilth {
namespace {

Vector6d motion_since_last(const MotionPrior& prior, const Pose& T_map_lidar) {
  return mean_velocity(prior.T_map_last, T_map_lidar, prior.interval);
}

Vector6d variances_of(double rotation_sigma, double translation_sigma) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
      Eigen::Vector3d::Constant(translation_sigma * translation_sigma);
  return variances;
}

bool accelerates(const MotionPrior& prior, const ContinuousTimeOptions& options) {
  return prior.known && options.motion_model == MotionModel::constant_acceleration;
}

}  // namespace

Vector6d pose_variances(const MotionPrior& prior, const ContinuousTimeOptions& options) {
  const double half_square = 0.5 * prior.interval * prior.interval;
  return variances_of(half_square * options.angular_acceleration, half_square * options.acceleration);
}

double steady_shift(const MotionPrior& prior, const ContinuousTimeOptions& options) {
  return 0.5 * prior.interval * prior.interval * options.steady_acceleration;
}

void add_pose_prior(const MotionPrior& prior, const ContinuousTimeOptions& options, const MotionState& state,
                    ContinuousTimeSystem& system) {
  const Vector6d weights = pose_variances(prior, options).cwiseInverse();
  system.H.topLeftCorner<6, 6>() += weights.asDiagonal();
  system.b.head<6>() += weights.cwiseProduct(log(predicted(prior).inverse() * state.T_map_lidar));
}

void add_claim(const MotionPrior& prior, const MotionState& state, ContinuousTimeSystem& system) {
  if (!prior.claim) return;
  constexpr double kSquaredWidth = 16;  // of the kernel; 6 is what a claim that holds comes to
  const Pose T_map_claimed = retract(prior.T_map_last, prior.claim->motion);
  const Vector6d off = log(T_map_claimed.inverse() * state.T_map_lidar);
  const Vector6d information = prior.claim->variances.cwiseInverse();
  const double doubt = 1 + off.cwiseAbs2().dot(information) / kSquaredWidth;
  const Vector6d weights = information / (doubt * doubt);  // Geman-McClure, as of the pairs
  system.H.topLeftCorner<6, 6>() += weights.asDiagonal();
  system.b.head<6>() += weights.cwiseProduct(off);
}

Vector6d acceleration_in(const MotionPrior& prior, const ContinuousTimeOptions& options, const MotionState& state) {
  if (!accelerates(prior, options)) return Vector6d::Zero();
  return 2 / prior.interval * (state.motion.velocity - motion_since_last(prior, state.T_map_lidar));
}

void add_velocity_prior(const MotionPrior& prior, const ContinuousTimeOptions& options, const MotionState& state,
                        ContinuousTimeSystem& system) {
  const double rate = 1 / prior.interval;
  const Vector6d motion = motion_since_last(prior, state.T_map_lidar);
  const Vector6d change = rate * (motion - prior.last_motion), surprise = change - prior.last_change;
  const Vector6d expected = accelerates(prior, options) ? Vector6d(motion + 0.5 * prior.interval * change) : motion;
  const auto sigma = [&](double seen) {
    return 0.5 * prior.interval * (options.velocity_slack + options.velocity_ratio * seen);
  };
  const Vector6d weights =
      variances_of(sigma(surprise.head<3>().norm()), sigma(surprise.tail<3>().norm())).cwiseInverse();
  Eigen::Matrix<double, 6, 12> J;  // what the motion is carried on by is taken for given in each step
  J << -rate * Matrix6d::Identity(), Matrix6d::Identity();
  const Eigen::Matrix<double, 12, 6> Jt = J.transpose() * weights.asDiagonal();
  system.H += Jt * J;
  system.b += Jt * (state.motion.velocity - expected);
}

void add_steady_prior(const MotionPrior& prior, const ContinuousTimeOptions& options, const Matrix6d& lost,
                      const MotionState& state, ContinuousTimeSystem& system) {
  const double change = prior.interval * options.steady_acceleration;
  const Pose T_map_steady = retract(prior.T_map_last, prior.steady_velocity * prior.interval);
  const auto add = [&](int at, double sigma, const Vector6d& residual) {
    const Matrix6d Jt = lost.transpose() / (sigma * sigma);
    system.H.block<6, 6>(at, at) += Jt * lost;
    system.b.segment<6>(at) += Jt * (lost * residual);
  };
  add(0, steady_shift(prior, options), log(T_map_steady.inverse() * state.T_map_lidar));
  add(6, change, state.motion.velocity - prior.steady_velocity);
}

}  // namespace tilth
