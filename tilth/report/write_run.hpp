// The files of a run. docs/outputs.md describes them.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <tilth/run/run_record.hpp>

namespace tilth {

/// The names of the files that write_run makes of a run, with loop closure or without. Throws Error as map_formats.
std::vector<std::string> run_files(const OutputOptions& options, bool loop_closure);

/// Writes trajectory.tum, trajectory_kitti.txt, scans.csv, summary.json, report.html (with plots/) and, as
/// `record.output` says, the map (map.pcd, map.ply, map.las) and run.mcap into `folder`, and with loop closure
/// trajectory_odometry.tum, closures.csv and pose_graph.g2o. A file that cannot be written does not keep the others
/// from it. Returns what went wrong, one sentence a file. `kept` are files that are left as they stand.
std::vector<std::string> write_run(const std::filesystem::path& folder, const RunRecord& record,
                                   const std::set<std::string>& kept = {});

}  // namespace tilth
