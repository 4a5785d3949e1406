#include <string>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/body_frame.hpp>
#include <tilth/evaluation/evaluate.hpp>

namespace tilth {
namespace {

MatchedPoses on_kitti_body(const MatchedPoses& matches, const Pose& T_kitti_lidar) {
  const Pose T_lidar_kitti = T_kitti_lidar.inverse();
  return {in_frame_of(matches.truth, T_lidar_kitti), in_frame_of(matches.estimate, T_lidar_kitti)};
}

Evaluation evaluate_matches(MatchedPoses matches, const EvaluationOptions& options) {
  if (matches.truth.size() < 2) {
    throw Error("evaluation", "needs at least 2 matching poses, not " + std::to_string(matches.truth.size()));
  }
  Evaluation evaluation;
  evaluation.options = options;
  const Pose start = relative_pose(matches.truth.front().T_world_lidar, matches.estimate.front().T_world_lidar);
  evaluation.start_distance = start.translation().norm();
  evaluation.start_angle = rotation_angle(start.linear());
  evaluation.alignment = alignment_of(matches, options.align);
  matches.estimate = transform(std::move(matches.estimate), evaluation.alignment);
  evaluation.ape = ape(matches);
  evaluation.rpe = rpe(matches, options.rpe);
  if (options.kitti) evaluation.kitti = kitti_metric(on_kitti_body(matches, options.T_kitti_lidar));
  const bool by_positions = options.align == Alignment::se3 || options.align == Alignment::sim3;
  if (by_positions) evaluation.open_roll = open_roll(matches);
  evaluation.matches = std::move(matches);
  return evaluation;
}

}  // namespace

Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate, const EvaluationOptions& options) {
  Evaluation evaluation = evaluate_matches(associate(truth, estimate, options.association), options);
  if (options.association.interpolate) evaluation.gap_limit = gap_limit(truth, options.association);
  evaluation.truth_poses = truth.size();
  evaluation.estimate_poses = estimate.size();
  return evaluation;
}

Evaluation evaluate_by_index(const Trajectory& truth, const Trajectory& estimate, const EvaluationOptions& options) {
  if (options.association.interpolate) throw Error("interpolate", "needs stamps in both trajectories");
  if (options.rpe.pairs.unit == DeltaUnit::seconds) throw Error("rpe_unit", "s needs stamps in both trajectories");
  Evaluation evaluation = evaluate_matches(associate_by_index(truth, estimate), options);
  evaluation.truth_poses = truth.size();
  evaluation.estimate_poses = estimate.size();
  return evaluation;
}

}  // namespace tilth
