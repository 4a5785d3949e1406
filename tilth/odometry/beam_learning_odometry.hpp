// Any pipeline with a calibration beside it, which learns the errors of the sensor's beams on the way (docs/beams.md).
#pragma once

#include <memory>

#include <tilth/calibration/beam_learner.hpp>
#include <tilth/odometry/beam_keyframe_gatherer.hpp>
#include <tilth/odometry/odometry.hpp>

namespace tilth {

/// What becomes of the errors that are found.
enum class BeamLearning {
  watch,    ///< nothing: poses are those of the pipeline alone
  correct,  ///< they are taken out of the scans that follow
};

class BeamLearningOdometry : public Odometry {
 public:
  /// `odometry` is one that make_odometry() made: its tracks are needed.
  BeamLearningOdometry(std::unique_ptr<Odometry> odometry, std::shared_ptr<BeamLearner> learner, BeamLearning learning);
  BeamLearningOdometry(const BeamLearningOdometry&) = delete;  // the odometry reports its stages to this very object
  BeamLearningOdometry& operator=(const BeamLearningOdometry&) = delete;

  /// A scan without rings is taken as it is.
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override { return odometry_->local_map(); }

 private:
  void learn(const Scan& scan, const OdometryResult& result);

  std::unique_ptr<Odometry> odometry_;
  BeamKeyframeGatherer gatherer_;
  std::shared_ptr<BeamLearner> learner_;
  BeamLearning learning_;
  std::size_t scans_ = 0, windows_ = 0;
};

}  // namespace tilth
