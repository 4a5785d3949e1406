// What a run tells people when it is over.
#pragma once

#include <string>

#include "console.hpp"
#include <tilth/output/run_record.hpp>

namespace tilth::app {

/// The figures of the run in a few lines, and where its files are.
void report_run(const RunRecord& record, const std::string& folder, Console& console);

}  // namespace tilth::app
