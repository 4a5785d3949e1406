// What another source tells of the motion between scans: wheel odometry, an IMU, another odometry; and how far it is
// believed. The scans judge it: what they find themselves is what its deviations are learned from.
#pragma once

#include <optional>
#include <vector>

#include <tilth/core/trajectory.hpp>
#include <tilth/registration/motion_prior.hpp>

namespace tilth {

/// A motion between two instants from outside.
class ExternalMotion {
 public:
  /// Poses of the LiDAR in any frame that stays; what their frame drifts by does not matter. Throws Error where there
  /// are fewer than two, or stamps that do not ascend.
  explicit ExternalMotion(Trajectory poses);

  /// T_from_to, the LiDAR at `to` [s] as seen from where it was at `from`; none where the poses do not reach so far or
  /// leave a gap of more than half a second about one of the two. O(log poses).
  std::optional<Pose> between(double from, double to) const;

 private:
  bool covers(double time) const;

  Trajectory poses_;
};

/// How far the motions of one source are believed: their deviation from what was registered is learned over the last
/// three seconds, and twice that is what is claimed; on top of it a share of the motion, which is a third until the
/// source was seen in motion. A source whose motions are always too long or too short by the same share (wheels worn, a
/// diameter that is wrong) is set right by it. Nothing is claimed before two seconds of scans have judged the source,
/// or where a motion asks for more than a robot's accelerations.
class MotionTrust {
 public:
  /// What `told`, a motion of `interval` [s], adds to the expectation of `velocity` [rad/s, m/s].
  std::optional<MotionClaim> claim(const Pose& T_from_to, double interval, const Vector6d& velocity) const;

  /// `found` is what the scan came to; `lost` * x the part of a motion x that it could not tell.
  void judge(const Pose& T_from_to, const Pose& found, double interval, const Matrix6d& lost);

 private:
  /// Sums over the motions that were told and found, faded, beginning with a scale of one and a third's doubt of it.
  struct MotionScale {
    double product, told, off;
    double scale() const { return product / told; }
    double squared_share() const { return off / told; }
    void add(const Eigen::Vector3d& told_motion, const Eigen::Vector3d& found_motion, double faded);
  };

  Vector6d scaled(Vector6d motion) const;

  Vector6d squares_ = Vector6d::Zero();  ///< [rad^2, m^2] mean square of the deviations of a motion
  MotionScale turn_{4e-3, 4e-3, 4e-4}, shift_{5e-2, 5e-2, 5e-3};  ///< [rad^2] [m^2] of a dozen scans at usual speeds
  double judged_ = 0.0;                                           ///< [s] of scans
};

/// The velocity that a claim and the one expected come to, which a robot's accelerations may change in `interval` [s].
Vector6d joined_velocity(const Vector6d& velocity, const MotionClaim& claim, double interval);

}  // namespace tilth
