// The columns of a scans.csv, read back. O(bytes).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tilth/core/track_state.hpp>

namespace tilth {

using ScanColumns = std::map<std::string, std::vector<double>>;  ///< by name, all of the same length

/// Throws Error naming file and line where a row has another number of columns than the header, or a word no number.
ScanColumns read_scan_columns(const std::filesystem::path& path);

/// The state of the track in each row. Throws Error as read_scan_columns, and where there is no such column, or a word
/// in it that is no state.
std::vector<TrackState> read_track_states(const std::filesystem::path& path);

/// The mean of a column, or zero where it is missing or empty.
double mean_of(const ScanColumns& columns, const std::string& name);

}  // namespace tilth
