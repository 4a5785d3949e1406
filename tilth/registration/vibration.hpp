// The vibration of a scan, estimated together with its pose and velocity: deviations from constant acceleration at nine
// instants, as large as the last scans have shown them to be. A robot that rolls smoothly has next to none, a shaking
// cart tenths of a degree.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <tilth/registration/continuous_time_system.hpp>
#include <tilth/registration/vibration_options.hpp>

namespace tilth {

/// Of the values of a coordinate at the knots.
using KnotMatrix = Eigen::Matrix<double, ScanVibration::kIntervals + 1, ScanVibration::kIntervals + 1>;

/// Vibration prior (docs/method.md, 10): the inverse of the correlation between the knots of a scan of this duration
/// [s], where vibrations of any frequency from `lowest` to `highest` are as likely: what a scan shows of a knot tells
/// about those beside it.
KnotMatrix knot_precision(double duration, const VibrationOptions& options);

/// What is known of a vibration before its scan: the knots of a coordinate are jointly normal.
struct VibrationPrior {
  ScanVibration means;
  KnotMatrix precision = KnotMatrix::Identity();  ///< of knots of variance 1
  Vector6d variances = Vector6d::Zero();
  Vector6d sigma_variances = Vector6d::Zero();  ///< if the means were zero and nothing else known
};

/// What the prior of a vibration depends on, beside what was seen of others.
struct VibratingScan {
  double ratio = 0.0;  ///< weight of the scan in the mean of vibrations
  double scale = 1.0;  ///< of the residuals: squares over the variances that their pairs promise
  KnotMatrix precision = KnotMatrix::Identity();  ///< of knots of variance 1
};

/// The mean of vibrations held to zero (docs/method.md, 12). A vibration goes to and fro: one that stayed at an instant
/// of the scan, from scan to scan, would let the part of the map that is seen at that instant leave the other parts,
/// and nothing would bring it back: the mean of the vibrations over three seconds is held to zero as well. `mean` is
/// that of those before the scan.
VibrationPrior vibration_prior(const VibrationSigma& sigma, const ScanVibration& mean, const VibratingScan& scan,
                               const VibrationOptions& options);

/// Pose, velocity and vibration of one linearisation: H x = -b.
struct VibrationSystem {
  static constexpr int kSize = 12 + 6 * (ScanVibration::kIntervals + 1);

  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  Matrix H = Matrix::Zero();
  Vector b = Vector::Zero();
};

using VibrationFactor = Eigen::LLT<VibrationSystem::Matrix>;  ///< of H
VibrationFactor factor_of(const VibrationSystem& system);

/// Of the `parts` of a scan at `state`, whose pose and velocity, with their priors, are `smooth`.
VibrationSystem vibration_system(const SegmentSystems& parts, const ContinuousTimeSystem& smooth,
                                 const VibrationPrior& prior, const MotionState& state);

/// Moves `vibration` and gives the step of pose and velocity; false where there is no solution.
bool step_with_vibration(const VibrationSystem& system, const VibrationFactor& factor, Vector12d& step,
                         ScanVibration& vibration);

/// [rad^2, m^2] of the pose in the middle of the scan, its vibration included.
Matrix6d covariance_in_middle(const VibrationFactor& factor);

/// What a vibration, estimated by the system of this factor, tells about the size of vibrations.
VibrationEvidence evidence_of(const VibrationFactor& factor, const VibrationPrior& prior,
                              const ScanVibration& vibration);

}  // namespace tilth
