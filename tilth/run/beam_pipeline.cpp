#include <utility>

#include <tilth/run/beam_pipeline.hpp>

namespace tilth {

Pipeline with_beams(std::unique_ptr<Odometry> odometry, BeamLearning learning, std::optional<BeamEstimate> known) {
  auto learner = std::make_shared<BeamLearner>(BeamCalibrationOptions{}, std::move(known));
  auto around = std::make_unique<BeamLearningOdometry>(std::move(odometry), learner, learning);
  return {.odometry = std::move(around), .beams = std::move(learner)};
}

}  // namespace tilth
