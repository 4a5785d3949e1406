// What a run is called at its beginning, and what it tells people when it is over.
#pragma once

#include <string>
#include <vector>

#include "console.hpp"
#include "option_arguments.hpp"
#include <tilth/run/run_record.hpp>

namespace tilth::app {

/// Values of MapOptions, OutputOptions and ReportOptions.
struct RecordValues {
  OptionValues map, output, report;
};

/// A record without scans. Throws Error on an unknown key or bound, and as describe_odometry.
RunRecord new_record(const std::string& source, const PipelineChoice& choice, const RecordValues& values);

/// Adds options in force, and what they are by default, to those of the pipeline.
void add_options(std::vector<OptionInfo> options, std::vector<OptionInfo> defaults, RunRecord& record);

/// The figures of the run in a few lines, and where its files are.
void report_run(const RunRecord& record, const std::string& folder, Console& console);

}  // namespace tilth::app
