// A pipeline as a run drives it: an odometry, with loop closure around it or without.
#pragma once

#include <memory>
#include <vector>

#include <tilth/odometry/odometry.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth {

class BeamLearner;

struct Pipeline {
  std::unique_ptr<Odometry> odometry;
  Slam* slam = nullptr;                          ///< in `odometry`, with loop closure
  std::shared_ptr<BeamLearner> beams = nullptr;  ///< that learns beside it
};

/// The same with loop closure. Throws Error on options that are wrong.
Pipeline with_loop_closure(Pipeline pipeline, const SlamOptions& options);

/// T_after_before of each pose, by which a map that was built with the poses `before` moves.
std::vector<Pose> corrections(const Trajectory& before, const Trajectory& after);

/// Optimises for the last time; then trajectory and map of `record` are the corrected ones, and what led there stands
/// in `record.loops`.
void close_loops(Slam& slam, RunRecord& record);

}  // namespace tilth
