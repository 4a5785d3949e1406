// Trajectories as text: TUM ("stamp tx ty tz qx qy qz qw") and KITTI (12 numbers, the upper 3x4 of a pose, row by row).
// '#' comments, blank lines, commas and CRLF are accepted. Throws Error naming file and line. O(lines).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <tilth/core/trajectory.hpp>

namespace tilth {

/// Stamps [s] must ascend; quaternions are normalised, one of zero length is refused.
Trajectory read_tum(const std::filesystem::path& path);
Trajectory parse_tum(std::string_view text, const std::string& name);
/// Values are written with as many digits as reading back the same doubles takes, stamps with at least 9 decimals.
void write_tum(const std::filesystem::path& path, const Trajectory& trajectory);
std::string tum_line(const StampedPose& pose);  ///< of such a file, with its end

/// Poses as they stand in the file (KITTI's own are of camera 0). A 3x3 that is no rotation within 1e-3 is refused.
std::vector<Pose> read_kitti_poses(const std::filesystem::path& path);
std::vector<Pose> parse_kitti_poses(std::string_view text, const std::string& name);
void write_kitti_poses(const std::filesystem::path& path, const Trajectory& trajectory);

}  // namespace tilth
