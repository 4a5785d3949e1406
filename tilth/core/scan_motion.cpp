#include <tilth/core/scan_motion.hpp>

namespace tilth {

MotionInScan MotionInScan::steady(const Vector6d& velocity, double middle) {
  return {.velocity = velocity, .begin = -middle, .duration = 2 * middle};
}

bool MotionInScan::at_rest() const {
  return velocity.isZero(0) && acceleration.isZero(0) && vibration.none();
}

Pose MotionInScan::after(double time) const {
  return exp(time * (velocity + 0.5 * time * acceleration));
}

Pose MotionInScan::at(double time) const {
  return exp(vibration.at(ratio(time))) * after(time);
}

MotionInScan MotionInScan::from(double time) const {
  MotionInScan later{velocity + time * acceleration, acceleration, begin - time, duration, vibration};
  for (Vector6d& knot : later.vibration.knots) knot -= vibration.at(ratio(time));
  return later;
}

ScanMotion::ScanMotion(const MotionInScan& motion, double reference_time)
    : motion_(motion),
      reference_time_(reference_time),
      begin_(reference_time + motion.begin),
      step_(motion.duration / kIntervals) {
  for (std::size_t i = 0; i <= kIntervals; ++i) {
    const double lever = step_ * double(i) + motion.begin;
    const Pose T = exp(motion.vibration.at(double(i) / kIntervals)) * motion.after(lever);
    const Vector6d velocity = motion.velocity + lever * motion.acceleration;
    R_reference_knot_[i] = T.linear();
    t_reference_knot_[i] = T.translation();
    angular_[i] = velocity.head<3>(), linear_[i] = velocity.tail<3>();
    turn_[i] = T.linear() * skew(angular_[i]);
  }
}

Pose ScanMotion::at(double time) const {
  const std::size_t i = knot(time);
  if (i == kNone) return motion_.at(time - reference_time_);
  const double rest = since_knot(time, i);
  const Eigen::Matrix3d& R = R_reference_knot_[i];
  Pose T_reference_time = Pose::Identity();
  T_reference_time.translation() = t_reference_knot_[i] + rest * (R * linear_[i]);
  T_reference_time.linear() = R + rest * turn_[i];
  return T_reference_time;
}

}  // namespace tilth
