#include <cmath>

#include <tilth/odometry/motion_filter.hpp>

namespace tilth {

MotionPrior MotionFilter::predict(double time) const {
  MotionPrior prior = last_;
  prior.interval = since_last(time);
  prior.vibration = vibration_.sigma();
  prior.vibration_mean = vibration_.mean();
  prior.vibration_gain = mean_gain(std::abs(prior.interval));
  return prior;
}

void MotionFilter::update(double time, const ContinuousTimeAlignment& alignment) {
  const double interval = since_last(time);
  update_velocities(interval, alignment);
  vibration_.update(interval, alignment.motion.vibration, alignment.evidence);
  last_time_ = time;
  ++updates_;
}

void MotionFilter::update_velocities(double interval, const ContinuousTimeAlignment& alignment) {
  constexpr double kMemory = 1.0;  // [s] of the steady velocity
  const bool told = interval > 0 && alignment.pose.matches > 0;
  const Vector6d motion =
      told ? mean_velocity(last_.T_map_last, alignment.pose.T_target_source, interval) : last_.last_motion;
  const double gain = last_.known ? 1 - std::exp(-interval / kMemory) : 1.0;
  last_.T_map_last = alignment.pose.T_target_source;
  last_.velocity = alignment.motion.velocity;
  last_.last_change = told && last_.known ? Vector6d((motion - last_.last_motion) / interval) : Vector6d::Zero();
  last_.last_motion = motion;
  last_.steady_velocity += gain * (motion - last_.steady_velocity);
  last_.known |= told;
}

}  // namespace tilth
