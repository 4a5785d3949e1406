// The report of a run: what became of it, drawn. docs/report.md describes the page.
#pragma once

#include <tilth/report/report.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

/// At most `map_points` points of the map go into the page.
Report report_of(const RunRecord& record, std::size_t map_points);

}  // namespace tilth
