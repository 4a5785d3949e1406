// What a run tells people when it is over.
#pragma once

#include <string>
#include <vector>

#include "console.hpp"
#include <tilth/run/run_record.hpp>

namespace tilth::app {

/// The figures of the run in a few lines, and where its files are.
void report_run(const RunRecord& record, const std::string& folder, const std::vector<std::string>& files,
                Console& console);

}  // namespace tilth::app
