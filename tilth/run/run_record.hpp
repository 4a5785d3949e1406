// A run as a value: everything that it has worked out so far. Sinks (sink.hpp) make files of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tilth/calibration/beam_calibration.hpp>
#include <tilth/core/options.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/freespace/floor_plane.hpp>
#include <tilth/run/localization_record.hpp>
#include <tilth/run/loop_record.hpp>
#include <tilth/run/map_builder.hpp>
#include <tilth/run/scan_table.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

struct RunRecord {
  std::string version, source, pipeline;
  std::string machine;                 ///< in words
  std::vector<OptionInfo> options;     ///< in force
  std::vector<OptionInfo> defaults;    ///< of the same pipeline
  std::vector<std::string> decisions;  ///< of the source, one sentence each
  std::vector<SkippedScan> skipped;    ///< records of the input that have no pose, and why
  std::vector<std::string> notices;    ///< of the source: packets lost, scans dropped ...; one sentence each
  std::string ended;                   ///< why no more scans were registered: "end of input", "interrupted" ...
  Trajectory trajectory;               ///< of the LiDAR; base_frame.hpp makes poses of base_link of it
  std::optional<Pose> T_map_odom;  ///< with loop closure, while it goes on: what is known of the newest pose's drift
  std::optional<Pose>
      T_base_lidar;                 ///< the LiDAR on the robot, where that is known: the world then begins at base_link
  std::optional<FloorPlane> floor;  ///< that the world was levelled by, before that
  ScanTable scans;
  MapBuilder map{MapOptions{}};
  std::optional<BeamCalibration> beams;  ///< what the drive shows of the sensor's beams
  std::optional<LoopRecord> loops;       ///< with loop closure; then `trajectory` and `map` are the corrected ones
  std::optional<LocalizationRecord> localization;  ///< in a saved map; then `trajectory` has the located scans only
  std::optional<Evaluation> evaluation;            ///< where the truth is known
  double wall_seconds = 0.0;                       ///< [s] of the whole run, files not counted
  double peak_megabytes = 0.0;                     ///< [MB] resident
};

}  // namespace tilth
