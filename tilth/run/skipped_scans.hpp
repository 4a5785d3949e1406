// Records of the input that have no pose: kept, and said.
#pragma once

#include <tilth/run/run_observer.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

/// Adds it to `record.skipped`; `observer` hears of the first ten.
void keep_skipped(SkippedScan skipped, RunObserver& observer, RunRecord& record);

}  // namespace tilth
