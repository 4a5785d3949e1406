#include <algorithm>
#include <utility>

#include <tilth/odometry/beam_learning_odometry.hpp>

namespace tilth {
namespace {

constexpr std::size_t kAtOnce = 3;         // windows that are taken as they come
constexpr std::size_t kScansAWindow = 60;  // of those after them, so that learning takes little of the time

bool correctable(const PointCloud& cloud, const BeamModel& beams) {
  if (beams.ideal() || !cloud.has_rings() || cloud.empty()) return false;
  return *std::max_element(cloud.rings.begin(), cloud.rings.end()) < beams.beams();
}

}  // namespace

BeamLearningOdometry::BeamLearningOdometry(std::unique_ptr<Odometry> odometry, std::shared_ptr<BeamLearner> learner,
                                           BeamLearning learning)
    : odometry_(std::move(odometry)), gatherer_(learner->options()), learner_(std::move(learner)), learning_(learning) {
  odometry_->listen([this](std::string_view stage) { begin_stage(stage); });
}

OdometryResult BeamLearningOdometry::register_scan(const Scan& scan) {
  const bool correct = learning_ == BeamLearning::correct && correctable(scan.cloud, learner_->beams());
  OdometryResult result =
      correct ? odometry_->register_scan(corrected(scan, learner_->beams())) : odometry_->register_scan(scan);
  begin_stage("beams");
  learn(scan, result);
  return result;
}

void BeamLearningOdometry::learn(const Scan& scan, const OdometryResult& result) {
  ++scans_;
  learner_->work();
  const bool due = windows_ < kAtOnce || windows_ * kScansAWindow <= scans_;
  if (!due && gatherer_.left_over() == 0) return;
  if (auto window = gatherer_.take(scan, scan.cloud, result)) {
    ++windows_;
    learner_->add(std::move(*window), gatherer_.rings(), gatherer_.bright());
  }
}

}  // namespace tilth
