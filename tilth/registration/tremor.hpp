// The tremor of a scan, estimated together with its pose and velocity: deviations from constant acceleration at nine
// instants, as large as the last scans have shown them to be (empirical Bayes, after MacKay 1992). A robot that rolls
// smoothly has next to none, a shaking cart tenths of a degree.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <tilth/registration/moving_system.hpp>
#include <tilth/registration/tremor_options.hpp>

namespace tilth {

/// Standard deviations of the tremor.
struct TremorSpread {
  double tilt = 0.0;         ///< [rad] about x and y of the LiDAR
  double yaw = 0.0;          ///< [rad] about z, the axis of its spin
  double translation = 0.0;  ///< [m] along each axis

  bool none() const { return tilt == 0.0 || yaw == 0.0 || translation == 0.0; }

  Vector6d variances() const {
    Vector6d v;
    v << tilt * tilt, tilt * tilt, yaw * yaw, Eigen::Vector3d::Constant(translation * translation);
    return v;
  }
};

/// As the last scans have shown it.
TremorSpread seen_spread(const TremorEvidence& evidence, const TremorOptions& options);

/// The same within the bounds of the options, by which parts of the map stay together.
TremorSpread tremor_spread(const TremorEvidence& evidence, const TremorOptions& options);

/// What is believed before the first scans: a platform may shake, until they show that it does not. A spread that
/// began at its least would be slow to leave it, for as long as the map takes up what tremor there is.
TremorEvidence first_evidence(const TremorOptions& options);

/// Of the values of a coordinate at the knots.
using KnotMatrix = Eigen::Matrix<double, ScanTremor::kIntervals + 1, ScanTremor::kIntervals + 1>;

/// The inverse of the correlation between the knots of a scan of this duration [s], where vibrations of any frequency
/// from `lowest` to `highest` are as likely: what a scan shows of a knot tells about those beside it.
KnotMatrix knot_precision(double duration, const TremorOptions& options);

/// What is known of a tremor before its scan: the knots of a coordinate are jointly normal.
struct TremorPrior {
  ScanTremor means;
  KnotMatrix precision = KnotMatrix::Identity();  ///< of knots of variance 1
  Vector6d variances = Vector6d::Zero();
  Vector6d spread_variances = Vector6d::Zero();  ///< if the means were zero and nothing else known
};

/// What the prior of a tremor depends on, beside what was seen of others.
struct TremblingScan {
  double share = 0.0;  ///< weight of the scan in the mean of tremors
  double scale = 1.0;  ///< of the residuals: squares over the variances that their pairs promise
  KnotMatrix precision = KnotMatrix::Identity();  ///< of knots of variance 1
};

/// A tremor goes to and fro. One that stayed at an instant of the scan, from scan to scan, would let the part of the
/// map that is seen at that instant leave the other parts, and nothing would bring it back: the mean of the tremors
/// over three seconds is held to zero as well. `mean` is that of those before the scan.
TremorPrior tremor_prior(const TremorSpread& spread, const ScanTremor& mean, const TremblingScan& scan,
                         const TremorOptions& options);

/// The weight of a scan in the mean of about three seconds, `interval` [s] after the last one.
double share_of_mean(double interval);

/// What is left of the evidence after `interval` [s], and the fresh one.
TremorEvidence faded_sum(const TremorEvidence& old, const TremorEvidence& fresh, double interval);

/// The mean after a scan of this tremor.
ScanTremor mean_with(const ScanTremor& mean, const ScanTremor& tremor, double share);

/// What of a tremor goes to and fro. The mean that it is seen about is an error of the map: what is put into the map
/// without it lets the map come to rest where no instant of a scan leads another.
ScanTremor without(const ScanTremor& tremor, const ScanTremor& mean);

/// Pose, velocity and tremor of one linearisation: H x = -b.
struct TremblingSystem {
  static constexpr int kSize = 12 + 6 * (ScanTremor::kIntervals + 1);

  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  Matrix H = Matrix::Zero();
  Vector b = Vector::Zero();
};

using TremblingFactor = Eigen::LLT<TremblingSystem::Matrix>;  ///< of H

/// Of the `parts` of a scan at `state`, whose pose and velocity, with their priors, are `smooth`.
TremblingSystem trembling_system(const MovingParts& parts, const MovingSystem& smooth, const TremorPrior& prior,
                                 const MotionState& state);

/// Moves `tremor` and gives the step of pose and velocity; false where there is no solution.
bool step_trembling(const TremblingSystem& system, const TremblingFactor& factor, Vector12d& step, ScanTremor& tremor);

/// [rad^2, m^2] of the pose in the middle of the scan, its tremor included.
Matrix6d covariance_in_middle(const TremblingFactor& factor);

/// What a tremor, estimated by the system of this factor, tells about the spread.
TremorEvidence evidence_of(const TremblingFactor& factor, const TremorPrior& prior, const ScanTremor& tremor);

}  // namespace tilth
