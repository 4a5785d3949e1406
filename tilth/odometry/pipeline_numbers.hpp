// Which options of a pipeline are numbers without fraction: by the table of make_odometry.cpp, which alone knows all.
#pragma once

#include <set>
#include <string>

namespace tilth {

/// Their keys. Throws Error on an unknown name.
std::set<std::string> whole_numbers_of(const std::string& pipeline);

}  // namespace tilth
