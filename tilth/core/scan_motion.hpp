// The motion of the LiDAR within one scan in continuous time: at constant acceleration but for its vibration
// (docs/method.md, 3), by poses at regular times; in between, along the tangent (error below 0.02 mm at 20 m and 90
// degrees a second).
#pragma once

#include <array>
#include <limits>

#include <tilth/core/scan_vibration.hpp>
#include <tilth/core/se3.hpp>

namespace tilth {

/// How the LiDAR moves about an instant of its scan, in its own frame. Times [s] count from that instant.
struct MotionInScan {
  Vector6d velocity = Vector6d::Zero();      ///< [rad/s, m/s] at the instant
  Vector6d acceleration = Vector6d::Zero();  ///< [rad/s^2, m/s^2]
  double begin = 0.0;                        ///< [s] of the scan, and the first knot of its vibration
  double duration = 0.0;                     ///< [s] of the scan, from the first knot to the last one
  ScanVibration vibration = {};              ///< beside velocity and acceleration

  /// About the middle of a scan, `middle` after its beginning, at constant velocity.
  static MotionInScan steady(const Vector6d& velocity, double middle);

  bool at_rest() const;

  /// Which part of the scan is over at `time`.
  double ratio(double time) const { return duration > 0 ? (time - begin) / duration : 0.0; }

  Pose after(double time) const;         ///< where it is after `time`, but for the vibration
  Pose at(double time) const;            ///< where it is at `time`
  MotionInScan from(double time) const;  ///< the same motion about an instant `time` later
};

/// The same, worked out beforehand for all points of the scan. Whoever moves points of a scan by its motion, for the
/// registration, a map or an output, moves them alike: what they have left of the scan does not matter.
class ScanMotion {
 public:
  /// `motion` is the LiDAR's about `reference_time`, the instant that all points are to be seen from. Times [s] count
  /// from the stamp of the scan.
  ScanMotion(const MotionInScan& motion, double reference_time);

  /// Where the LiDAR was at `time`, seen from where it was at the reference time.
  Pose at(double time) const;

  /// The rotation of at(time), to half a knot: within 0.07 degrees at 90 degrees a second.
  Eigen::Matrix3d rotation(double time) const {
    const std::size_t i = knot(time);
    return i == kNone ? Eigen::Matrix3d(motion_.at(time - reference_time_).linear()) : R_reference_knot_[i];
  }

  /// at(time) * p.
  Eigen::Vector3d move(const Eigen::Vector3d& p, double time) const {
    const std::size_t i = knot(time);
    if (i == kNone) return motion_.at(time - reference_time_) * p;
    return R_reference_knot_[i] * (p + since_knot(time, i) * (angular_[i].cross(p) + linear_[i])) +
           t_reference_knot_[i];
  }

 private:
  static constexpr std::size_t kIntervals = 64;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// The nearest one, or kNone outside the scan.
  std::size_t knot(double time) const {
    const double steps = (time - begin_) / step_ + 0.5;
    return steps >= 0 && steps < double(kIntervals + 1) ? std::size_t(steps) : kNone;
  }

  double since_knot(double time, std::size_t i) const { return time - begin_ - step_ * double(i); }

  MotionInScan motion_;
  double reference_time_, begin_, step_;  // [s]
  std::array<Eigen::Matrix3d, kIntervals + 1> R_reference_knot_;
  std::array<Eigen::Matrix3d, kIntervals + 1> turn_;  // [1/s] derivative of that
  std::array<Eigen::Vector3d, kIntervals + 1> t_reference_knot_;
  std::array<Eigen::Vector3d, kIntervals + 1> angular_, linear_;  // [rad/s, m/s] in the LiDAR's frame
};

}  // namespace tilth
