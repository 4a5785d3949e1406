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

void WorldFrame::anchor(const std::optional<Pose>& T_map_first) {
  if (T_map_first) T_world_map_ = T_map_first->inverse();
  first_.reset();
}

}  // namespace tilth
