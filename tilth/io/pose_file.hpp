// A trajectory file of whatever kind: columns by their names where a header has them (EuRoC, ROS, Newer College ...),
// else 8 numbers a line are TUM and 12 are KITTI. O(characters).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/trajectory.hpp>

namespace tilth {

struct PoseFile {
  Trajectory trajectory;             ///< of a file without stamps, the stamp is the pose's number, from 0
  bool has_stamps = false;           ///< [s] whatever their unit in the file
  std::vector<std::string> notices;  ///< how it was understood, where that is not plain; one sentence each
};

/// Stamps whose unit is not told are taken for ms, us or ns where they are too large, or too far apart, for seconds.
/// Throws Error naming file, line and field where a number is missing or not finite, or a header does not name the
/// columns of a pose.
PoseFile read_pose_file(const std::filesystem::path& path);
PoseFile parse_pose_file(std::string_view text, const std::string& name);

}  // namespace tilth
