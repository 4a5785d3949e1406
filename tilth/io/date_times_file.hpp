// Times of scans as dates: one "2011-09-26 13:02:25.951199337" a line, as KITTI's raw recordings have them. O(lines).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tilth {

/// [s] since 1970, leap seconds not counted, in the order of the file; blank lines are left out. Throws Error naming
/// file and line where a line is no date with a time of day, and for a file without any.
std::vector<double> read_date_times(const std::filesystem::path& path);
std::vector<double> parse_date_times(std::string_view text, const std::string& name);

}  // namespace tilth
