// A run as an MCAP recording of ROS 2 messages, which Foxglove and `ros2 bag play` open: /odometry and /tf a pose,
// /path and /map once, at the first stamp. Frames "world" and "lidar".
#pragma once

#include <filesystem>

#include <tilth/output/run_record.hpp>

namespace tilth {

/// Throws Error where it cannot be written, or a stamp lies outside [0, 2^32 - 1) s.
void write_run_mcap(const std::filesystem::path& path, const RunRecord& record);

}  // namespace tilth
