// A run as ROS 2 messages (CDR): what run.mcap holds, and what a live view sends. Frames: world; the body that the
// poses are of (base_link, else lidar); lidar; and, while loops are being closed, odom between world and body, in which
// poses are smooth (REP 105, whose map is the world here). About 0.5 ms a scan of 5,000 points, 1 us a pose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/core/point_records.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/messages/diagnostic_message.hpp>
#include <tilth/messages/pose_message.hpp>
#include <tilth/messages/ros2_definitions.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

struct OdometryResult;
struct Scan;

enum class RunTopic : std::uint8_t { path, map, tf, odometry, scan, diagnostics };
inline constexpr std::size_t kRunTopics = 6;

struct NamedTopic {
  std::string name;  ///< "/odometry"
  Ros2Type type;
};

/// In the order of RunTopic.
std::vector<NamedTopic> run_topics();

/// How the frames of the messages lie to one another.
struct RunFrames {
  std::optional<Pose> T_base_lidar = {};  ///< nothing: poses are of the LiDAR
  std::optional<Pose> T_map_odom = {};    ///< nothing: poses are given in the world
};

RunFrames frames_of(const RunRecord& record);

/// Those of poses, and of what is seen from them.
Frames names_in(const RunFrames& frames);

/// [ns] since 1970 of a stamp; 0 before.
std::uint64_t nanoseconds(double stamp);

/// All throw Error where a stamp lies outside [0, 2^32 - 1) s. Poses of the LiDAR go in, those of the body come out.
/// The scan is as the sensor would have seen it all at once at the stamp of its pose, in its own frame, without
/// outliers: every n-th point, so that no more than `points` remain.
std::vector<std::byte> scan_message(const Scan& scan, const OdometryResult& result, std::uint64_t points,
                                    const std::string& frame = "lidar",
                                    Serialization serialization = Serialization::cdr);
std::vector<std::byte> tf_message(const StampedPose& pose, const RunFrames& frames);
std::vector<std::byte> odometry_message(const StampedPose& pose, const Matrix6d& covariance, const RunFrames& frames);
std::vector<std::byte> path_message(const Trajectory& poses, const RunFrames& frames);
std::vector<std::byte> map_message(double stamp, PointRecords map, const std::string& frame,
                                   Serialization serialization = Serialization::cdr);

/// The state of the track, and what the scan took and gave.
Diagnostic track_diagnostic(const ScanRow& row);
std::vector<std::byte> diagnostics_message(const ScanRow& row);

/// How well the place in a saved map is known.
Diagnostic place_diagnostic(const LocalizationRow& row);
std::vector<std::byte> diagnostics_message(const LocalizationRow& row);

/// Every n-th pose and the last, so that about `most` remain.
Trajectory thinned(const Trajectory& poses, std::size_t most);

}  // namespace tilth
