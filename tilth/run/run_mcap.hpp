// run.mcap: a run as ROS 2 messages, as Foxglove and `ros2 bag play` take them. Clouds of scans are written while the
// run goes on, poses and map at its end. About 1 ms a scan of 5,000 points.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/core/trajectory.hpp>

namespace tilth {

class McapWriter;
struct RunRecord;

/// When and how a sensor moved that measured a scan, as MapBuilder::add() takes it.
struct MeasuredScan {
  double stamp = 0.0;      ///< [s] of the pose
  double pose_time = 0.0;  ///< [s] of the pose, on the clock of the points' times
  MotionInScan motion;     ///< about that instant
};

class RunMcap {
 public:
  /// `points` of a scan are written at most; 0: scans are not. Throws Error where the file cannot be made.
  RunMcap(const std::filesystem::path& path, std::uint64_t points);
  ~RunMcap();
  RunMcap(const RunMcap&) = delete;
  RunMcap& operator=(const RunMcap&) = delete;

  /// The scan as the sensor would have seen it all at once at the stamp of its pose, in its own frame. What fails is
  /// kept for finish().
  void add_scan(const PointCloud& cloud, const MeasuredScan& scan);

  /// Odometry and transform of each pose, path, map; only then does the file stand under its name. Throws Error where
  /// it cannot be written in full.
  void finish(const RunRecord& record);

 private:
  void write_scan(const PointCloud& cloud, const MeasuredScan& scan);

  std::unique_ptr<McapWriter> file_;
  std::uint64_t points_;
  std::uint32_t path_topic_, map_topic_, tf_topic_, odometry_topic_, scan_topic_;
  std::string problem_;
};

}  // namespace tilth
