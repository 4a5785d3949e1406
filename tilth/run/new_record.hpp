// The beginning of a record: what is run, with which options, by which version on which machine.
#pragma once

#include <string>
#include <vector>

#include <tilth/run/run_record.hpp>

namespace tilth {

/// A record without scans. `source` as open_source takes it; `pipeline` and `values` as make_odometry: throws alike.
RunRecord new_record(const std::string& source, const std::string& pipeline, const OptionValues& values);

/// Adds options in force, and what they are by default, to those of the pipeline.
void add_options(std::vector<OptionInfo> options, std::vector<OptionInfo> defaults, RunRecord& record);

}  // namespace tilth
