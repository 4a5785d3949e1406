// What the command line says of a true trajectory.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tilth::app {

/// --calib; what is given is as read_truth takes it. The strings outlive the parsing.
void add_calibration_flag(CLI::App& command, std::string& calibration);

/// --truth, with `purpose` in its description, and --calib.
void add_truth_flags(CLI::App& command, const std::string& purpose, std::string& truth, std::string& calibration);

}  // namespace tilth::app
