// Loop closure around a pipeline, and what is left to do once the last scan is registered.
#pragma once

#include <memory>

#include "option_arguments.hpp"
#include <tilth/run/run_record.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth::app {

struct Pipeline {
  std::unique_ptr<Odometry> odometry;
  Slam* slam = nullptr;  ///< `odometry` itself, with loop closure
};

/// The pipeline as chosen, with loop closure around it or without. Throws Error on options that are wrong.
Pipeline make_pipeline(const PipelineChoice& choice, bool loop_closure);

/// Optimises for the last time; then trajectory and map of `record` are the corrected ones, and what led there stands
/// in `record.loops`.
void close_loops(Slam& slam, RunRecord& record);

}  // namespace tilth::app
