// What loop closure made of a run: closures.csv, and the section `loop_closure` of summary.json. docs/loop_closure.md
// describes every column.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tilth/core/pose_graph.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/slam/loop_closing_thread.hpp>

namespace tilth {

/// A pair of keyframes that was looked at.
struct ClosureRow {
  std::size_t from_scan = 0, to_scan = 0;   ///< numbers of registered scans
  double from_stamp = 0.0, to_stamp = 0.0;  ///< [s]
  Constraint constraint;                    ///< between keyframes
  std::string found_by, verdict;
  double overlap = 0.0, back_overlap = 0.0, landmarks = 0.0;  ///< [-]
  double fitness = 0.0;                                       ///< [m]
  int degenerate_directions = 0;
  double squared_error = 0.0;  ///< [sigma^2] that the graph leaves of it
};

struct LoopRecord {
  Trajectory odometry = {};                      ///< of all scans, before loop closure
  PoseGraph graph = {};                          ///< of the keyframes
  std::vector<std::size_t> keyframe_scans = {};  ///< number of the registered scan that each keyframe is
  std::vector<ClosureRow> closures = {};
  int optimizations = 0;
  LoopTimes times = {};    ///< beside the scans
  double finish_ms = 0.0;  ///< of the last optimisation, the trajectory and the map
};

/// The scans of the two keyframes of each closure that was accepted.
std::vector<std::pair<std::size_t, std::size_t>> accepted_scans(const LoopRecord& loops);

/// Throws Error where the file cannot be written in full.
void write_closures(const std::filesystem::path& path, const std::vector<ClosureRow>& closures);

}  // namespace tilth
