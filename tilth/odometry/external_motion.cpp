#include <algorithm>
#include <cmath>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/odometry/external_motion.hpp>

namespace tilth {
namespace {

constexpr double kLongestGap = 0.5;   // [s]
constexpr double kMemory = 3.0;       // [s]
constexpr double kLongMemory = 30.0;  // [s] of the share
constexpr double kProbation = 2.0;    // [s]
// What a robot is capable of, as `tilth` takes it: align.acceleration, align.angular_acceleration.
constexpr double kAcceleration = 10.0, kAngularAcceleration = 20.0;  // [m/s^2] [rad/s^2]

/// Where a scan hardly tells of a direction, registration lags by a percent or two: a scale that is no more is not the
/// source's.
double sure_scale(double scale) {
  constexpr double kLeast = 0.03;
  return std::abs(scale - 1) > kLeast ? scale : 1.0;
}

/// [rad^2, m^2] by which a robot's accelerations change a motion of `interval` [s].
Vector6d expected_variances(double interval) {
  Vector6d accelerations;
  accelerations << Eigen::Vector3d::Constant(kAngularAcceleration), Eigen::Vector3d::Constant(kAcceleration);
  return (0.5 * interval * interval * accelerations).cwiseAbs2();
}

bool is_capable(const Vector6d& change, double interval) {
  constexpr double kMostSigma = 3.0;
  return change.head<3>().norm() <= kMostSigma * kAngularAcceleration * interval &&
         change.tail<3>().norm() <= kMostSigma * kAcceleration * interval;
}

}  // namespace

ExternalMotion::ExternalMotion(Trajectory poses) : poses_(std::move(poses)) {
  if (poses_.size() < 2) throw Error("prior", "has fewer than two poses");
  const auto not_later = [](const StampedPose& a, const StampedPose& b) { return b.stamp <= a.stamp; };
  if (std::adjacent_find(poses_.begin(), poses_.end(), not_later) != poses_.end())
    throw Error("prior", "has stamps that do not ascend");
}

bool ExternalMotion::covers(double time) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.stamp < t; });
  if (after == poses_.end()) return false;
  if (after->stamp == time) return true;
  return after != poses_.begin() && after->stamp - std::prev(after)->stamp <= kLongestGap;
}

std::optional<Pose> ExternalMotion::between(double from, double to) const {
  if (!covers(from) || !covers(to)) return std::nullopt;
  return interpolate(poses_, from).inverse() * interpolate(poses_, to);
}

Vector6d MotionTrust::scaled(Vector6d motion) const {
  motion.head<3>() *= sure_scale(turn_.scale());
  motion.tail<3>() *= sure_scale(shift_.scale());
  return motion;
}

std::optional<MotionClaim> MotionTrust::claim(const Pose& T_from_to, double interval, const Vector6d& velocity) const {
  if (judged_ < kProbation || interval <= 0) return std::nullopt;
  const Vector6d motion = scaled(log(T_from_to));
  if (!is_capable(motion / interval - velocity, interval)) return std::nullopt;
  constexpr double kLeastTurn = 1e-3, kLeastShift = 2e-3;  // [rad] [m] standard deviations, of a single motion
  constexpr double kCaution = 4.0;                         // of the variance: what was seen is a few scans
  Vector6d least;
  least << Eigen::Vector3d::Constant(kLeastTurn * kLeastTurn), Eigen::Vector3d::Constant(kLeastShift * kLeastShift);
  MotionClaim claim{motion, (kCaution * squares_).cwiseMax(least)};
  claim.variances.head<3>().array() += turn_.squared_share() * motion.head<3>().squaredNorm();
  claim.variances.tail<3>().array() += shift_.squared_share() * motion.tail<3>().squaredNorm();
  const bool says_more = (claim.variances.array() < expected_variances(interval).array()).all();
  return says_more ? std::optional(claim) : std::nullopt;  // than that the motion goes on
}

void MotionTrust::MotionScale::add(const Eigen::Vector3d& told_motion, const Eigen::Vector3d& found_motion,
                                   double faded) {
  off = faded * off + (scale() * told_motion - found_motion).squaredNorm();
  product = faded * product + told_motion.dot(found_motion);
  told = faded * told + told_motion.squaredNorm();
}

void MotionTrust::judge(const Pose& T_from_to, const Pose& found, double interval, const Matrix6d& lost) {
  if (interval <= 0) return;
  const Vector6d told = log(T_from_to), motion = log(found), off = scaled(told) - motion;
  const Vector6d seen = off - lost * off;
  const double gain = judged_ > 0 ? 1 - std::exp(-interval / kMemory) : 1.0;
  for (int i = 0; i < 6; ++i) {
    const double change = seen[i] * seen[i] - squares_[i];
    if (lost.isZero() || change > 0) squares_[i] += gain * change;  // what a scan cannot tell speaks for nobody
  }
  judged_ += interval;
  if (!lost.isZero()) return;
  const double faded = std::exp(-interval / kLongMemory);
  turn_.add(told.head<3>(), motion.head<3>(), faded);
  shift_.add(told.tail<3>(), motion.tail<3>(), faded);
}

Vector6d joined_velocity(const Vector6d& velocity, const MotionClaim& claim, double interval) {
  const Vector6d variances = expected_variances(interval);
  const Vector6d gain = variances.cwiseQuotient(variances + claim.variances);
  return velocity + gain.cwiseProduct(claim.motion / interval - velocity);
}

}  // namespace tilth
