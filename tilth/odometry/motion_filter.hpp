// What the scans so far tell about the motion of the next one: velocities, how they change, and the vibration.
#pragma once

#include <tilth/odometry/vibration_filter.hpp>
#include <tilth/registration/motion_prior.hpp>

namespace tilth {

class MotionFilter {
 public:
  explicit MotionFilter(const VibrationOptions& options) : vibration_(options) {}

  /// What is known of a scan whose middle is at `time` [s], which may also lie before the last one. Before any update
  /// the interval is 0.
  MotionPrior predict(double time) const;

  /// Takes what the registration of a scan has found, whose middle is at `time`.
  void update(double time, const ContinuousTimeAlignment& alignment);

  const VibrationFilter& vibration() const { return vibration_; }
  double last_time() const { return last_time_; }  ///< [s] of the last update

 private:
  double since_last(double time) const { return updates_ > 0 ? time - last_time_ : 0.0; }
  void update_velocities(double interval, const ContinuousTimeAlignment& alignment);

  MotionPrior last_;  // pose and velocities
  VibrationFilter vibration_;
  double last_time_ = 0.0;
  std::size_t updates_ = 0;
};

}  // namespace tilth
