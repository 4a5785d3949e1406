// A trajectory file of either format, told apart by its first line: 8 numbers are TUM, 12 are KITTI. O(lines).
#pragma once

#include <filesystem>

#include <tilth/core/trajectory.hpp>

namespace tilth {

struct PoseFile {
  Trajectory trajectory;    ///< of a file without stamps, the stamp is the pose's number, from 0
  bool has_stamps = false;  ///< TUM
};

/// Throws Error naming file and line where a line has another count of numbers than its format.
PoseFile read_pose_file(const std::filesystem::path& path);

}  // namespace tilth
