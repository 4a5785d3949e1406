// summary.json: a run in figures. docs/outputs.md describes every entry.
#pragma once

#include <string>

#include <tilth/evaluation/distribution.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

/// The figures that a run comes down to.
struct RunFigures {
  double recorded_seconds = 0.0;     ///< [s] last stamp - first stamp, and one mean interval for the last scan
  double registering_seconds = 0.0;  ///< [s] reading and map building not counted
  double real_time_factor = 0.0;     ///< recorded / registering; 0 where no stamps tell
  double distance = 0.0;             ///< [m] along the trajectory
  double end_to_start = 0.0;         ///< [m] from the last pose to the first
  Distribution register_ms;          ///< [ms] a scan
};

RunFigures figures_of(const RunRecord& record);

std::string summary_json(const RunRecord& record);

}  // namespace tilth
