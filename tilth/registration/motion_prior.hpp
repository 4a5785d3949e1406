// What is known of a motion before its scan: where it leads to, how sure that is, and what it adds to the normal
// equations of the scan.
#pragma once

#include <algorithm>
#include <optional>

#include <tilth/core/scan_vibration.hpp>
#include <tilth/registration/continuous_time_alignment.hpp>
#include <tilth/registration/continuous_time_options.hpp>
#include <tilth/registration/continuous_time_system.hpp>

namespace tilth {

/// What another source than the scans tells of the motion since the last pose.
struct MotionClaim {
  Vector6d motion = Vector6d::Zero();     ///< [rad, m] log of T_last_lidar
  Vector6d variances = Vector6d::Zero();  ///< [rad^2, m^2]
};

/// What is known before the scan. Instants are the middles of scans.
struct MotionPrior {
  Pose T_map_last = Pose::Identity();           ///< the last pose
  Vector6d velocity = Vector6d::Zero();         ///< [rad/s, m/s] expected, in the LiDAR's frame
  Vector6d last_motion = Vector6d::Zero();      ///< [rad/s, m/s] mean velocity between the last two poses
  Vector6d last_change = Vector6d::Zero();      ///< [rad/s^2, m/s^2] of that mean velocity, since the one before
  Vector6d steady_velocity = Vector6d::Zero();  ///< [rad/s, m/s] mean of about the last second
  double interval = 0.0;                        ///< [s] since the last pose; below 0 where that came after
  VibrationSigma vibration = {};                ///< of the scan's vibration; none: none is estimated
  ScanVibration vibration_mean = {};            ///< of the last scans' vibrations
  double vibration_gain = 0.0;                  ///< weight of the scan in that mean
  std::optional<MotionClaim> claim = {};        ///< from outside
  bool known = false;                           ///< false: nothing is known of the motion yet, only that it is steady
};

/// [rad/s, m/s] of a motion that leads from one pose to the other in `interval` [s], in the LiDAR's frame.
inline Vector6d mean_velocity(const Pose& T_map_last, const Pose& T_map_lidar, double interval) {
  return log(T_map_last.inverse() * T_map_lidar) / interval;
}

/// Where the velocity expected leads to; after a long interval it is not known to have gone on.
inline Pose predicted(const MotionPrior& prior) {
  constexpr double kCarriedOn = 1.0;  // [s] at most
  return retract(prior.T_map_last, prior.velocity * std::min(prior.interval, kCarriedOn));
}

/// [rad^2, m^2] of the pose predicted: by the accelerations that a robot is capable of.
Vector6d pose_variances(const MotionPrior& prior, const ContinuousTimeOptions& options);

/// [rad, m] standard deviation of a pose that goes on at the velocity of the last second.
double steady_shift(const MotionPrior& prior, const ContinuousTimeOptions& options);

/// Pose prior (docs/method.md, 8): the pose is where the velocity expected leads to, give or take the accelerations
/// that a robot is capable of.
void add_pose_prior(const MotionPrior& prior, const ContinuousTimeOptions& options, const MotionState& state,
                    ContinuousTimeSystem& system);

/// What another source claims (docs/method.md, 13a), the less the farther the scan is from it; nothing where there is
/// no claim.
void add_claim(const MotionPrior& prior, const MotionState& state, ContinuousTimeSystem& system);

/// Acceleration in the scan (docs/method.md, 4): what a velocity in the middle of the scan that differs from the motion
/// since the last one says: the scan is bent. [rad/s^2, m/s^2]; 0 before anything is known of the motion, and where
/// options want no scan bent.
Vector6d acceleration_in(const MotionPrior& prior, const ContinuousTimeOptions& options, const MotionState& state);

/// Velocity prior (docs/method.md, 9): the velocity in the middle of the scan is where the last two motions, half an
/// interval and one and a half before it, lead to, unless their acceleration is not that seen before: then it may
/// differ.
void add_velocity_prior(const MotionPrior& prior, const ContinuousTimeOptions& options, const MotionState& state,
                        ContinuousTimeSystem& system);

/// Prior of degenerate directions (docs/method.md, 13): of a motion x of the pose, `lost` * x goes on as it was in the
/// last second.
void add_steady_prior(const MotionPrior& prior, const ContinuousTimeOptions& options, const Matrix6d& lost,
                      const MotionState& state, ContinuousTimeSystem& system);

}  // namespace tilth
