// What is left to do for loop closure once the last scan is registered.
#pragma once

#include <tilth/output/run_record.hpp>
#include <tilth/slam/slam.hpp>

namespace tilth::app {

/// Adds the options of loop closure to those of the pipeline.
void add_options(const SlamOptions& options, RunRecord& record);

/// Optimises for the last time; then trajectory and map of `record` are the corrected ones, and what led there stands
/// in `record.loops`.
void close_loops(Slam& slam, RunRecord& record);

}  // namespace tilth::app
