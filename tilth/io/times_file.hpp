// Times of scans as text: one number [s] a line, '#' comments and blank lines left out. O(lines).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tilth {

/// [s] in the order of the file. Throws Error naming file and line where a line is not one finite number, and for a
/// file without any.
std::vector<double> read_times(const std::filesystem::path& path);
std::vector<double> parse_times(std::string_view text, const std::string& name);

}  // namespace tilth
