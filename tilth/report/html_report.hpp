// report.html: one file that needs nothing else, no network above all. Facts, tables and plots stand in it as HTML and
// SVG, so that it can be read and printed by anything; where the script of web/ was built into the program it makes the
// plots answer the mouse and adds the 3D view of the map. docs/report.md describes what the script reads.
#pragma once

#include <filesystem>
#include <string>

#include <tilth/report/report.hpp>

namespace tilth {

/// The page. Whatever the names in `report` hold stands in it as text.
std::string html_report(const Report& report);

/// Writes report.html, and each plot as plots/<id>.svg, into `folder`; plots of an earlier report are removed. Throws
/// Error naming the file that cannot be written.
void write_report(const std::filesystem::path& folder, const Report& report);

}  // namespace tilth
