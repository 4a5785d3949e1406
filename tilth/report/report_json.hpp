// What the script of report.html reads: curves, map and ways as JSON, numbers as base64 of 32-bit floats.
// docs/report.md describes every entry.
#pragma once

#include <string>
#include <vector>

#include <tilth/report/report.hpp>

namespace tilth {

/// Holds no '<': it can stand inside a script element whatever the names are.
std::string report_json(const Report& report);

/// The layers of the map after the first, one JSON each.
std::vector<std::string> later_layers_json(const Report& report);

}  // namespace tilth
