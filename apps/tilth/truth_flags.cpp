#include "truth_flags.hpp"

#include <CLI/CLI.hpp>

namespace tilth::app {

void add_calibration_flag(CLI::App& command, std::string& calibration) {
  command.add_option("--calib", calibration,
                     "KITTI's calib.txt or calib_velo_to_cam.txt, for a truth in the camera's frame; none: not even "
                     "one that lies beside the truth");
}

void add_truth_flags(CLI::App& command, const std::string& purpose, std::string& truth, std::string& calibration) {
  command.add_option("--truth", truth,
                     "true trajectory " + purpose + ": TUM, KITTI poses, or a table whose header names its columns");
  add_calibration_flag(command, calibration);
}

}  // namespace tilth::app
