#include <limits>

#include <tilth/odometry/world_frame.hpp>
#include <tilth/preprocess/deskew.hpp>

namespace tilth {

void WorldFrame::begin(const ScanPatches& first) {
  first_ = first;
  first_time_ = first.time();
  scans_ = 1;
}

void WorldFrame::add_second(const MotionPrior& back) {
  back_ = back;
  scans_ = 2;
}

SurfacePatches WorldFrame::first_patches(const Vector6d& velocity) const {
  return deskew(first_->patches, MotionInScan::steady(velocity, first_->middle()), first_->middle());
}

MotionPrior WorldFrame::prior_of_first(const VibrationSigma& vibration) const {
  MotionPrior prior = back_;
  prior.vibration = vibration;
  return prior;
}

void WorldFrame::anchor(double time, const std::optional<Pose>& T_map_first) {
  if (T_map_first) T_world_map_ = T_map_first->inverse();
  if (is_settled(time)) first_.reset();
}

bool WorldFrame::is_thin(double time) const {
  constexpr double kUntil = 1.0, kSpeed = 3.0;  // [s] [m/s]
  const bool anchored_once = reanchor_after_ < std::numeric_limits<double>::infinity();
  return anchored_once && age(time) < kUntil && back_.velocity.tail<3>().norm() > kSpeed;
}

}  // namespace tilth
