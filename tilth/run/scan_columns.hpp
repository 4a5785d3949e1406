// The columns of a scans.csv, read back. O(bytes).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tilth {

using ScanColumns = std::map<std::string, std::vector<double>>;  ///< by name, all of the same length

/// Throws Error naming file and line where a row has another number of columns than the header, or a word no number.
ScanColumns read_scan_columns(const std::filesystem::path& path);

/// The mean of a column, or zero where it is missing or empty.
double mean_of(const ScanColumns& columns, const std::string& name);

}  // namespace tilth
