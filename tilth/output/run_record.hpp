// Everything that a run has worked out, ready to be written at any moment.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/output/loop_record.hpp>
#include <tilth/output/map_builder.hpp>
#include <tilth/output/output_options.hpp>
#include <tilth/output/run_mcap.hpp>
#include <tilth/output/scan_table.hpp>

namespace tilth {

/// A record of the input that has no pose, and why.
struct SkippedRecord {
  std::size_t index = 0;  ///< in the recording
  std::string where, what;
};

struct ReportOptions {
  std::uint64_t points = 2'000'000;  ///< of the map that go into report.html; evenly thinned past that
};

template <class V>
void visit(ReportOptions& o, V&& v) {
  v("report_points", o.points, Bounds{0, 2e7}, "[points] of the map that go into report.html at most");
}

struct RunRecord {
  std::string version, source, pipeline;
  std::string machine;               ///< in words
  std::vector<OptionInfo> options;   ///< in force
  std::vector<OptionInfo> defaults;  ///< of the same pipeline
  ReportOptions report;
  std::vector<std::string> decisions;  ///< of the source, one sentence each
  std::vector<SkippedRecord> skipped;
  std::vector<std::string> notices;  ///< of the source: packets lost, scans dropped ...; one sentence each
  std::string ended;                 ///< why no more scans were registered: "end of input", "interrupted" ...
  Trajectory trajectory;
  ScanTable scans;
  MapBuilder map{MapOptions{}};
  OutputOptions output;
  std::shared_ptr<RunMcap> mcap;         ///< run.mcap as far as it is written; nothing: it is written as a whole
  std::optional<LoopRecord> loops;       ///< with loop closure; then `trajectory` and `map` are the corrected ones
  std::optional<Evaluation> evaluation;  ///< where the truth is known
  double wall_seconds = 0.0;             ///< [s] of the whole run, files not counted
  double peak_megabytes = 0.0;           ///< [MB] resident
};

/// Opens run.mcap in `folder` where it is asked for, so that scans can go into it. Throws Error where that fails.
void begin_mcap(const std::filesystem::path& folder, RunRecord& record);

/// The names of the files that write_run makes of a run, with loop closure or without. Throws Error as map_formats.
std::vector<std::string> run_files(const OutputOptions& options, bool loop_closure);

/// Writes trajectory.tum, trajectory_kitti.txt, scans.csv, summary.json, report.html (with plots/) and, as
/// `record.output` says, the map (map.pcd, map.ply, map.las) and run.mcap into `folder`, and with loop closure
/// trajectory_odometry.tum, closures.csv and pose_graph.g2o. A file that cannot be written does not keep the others
/// from it. Returns what went wrong, one sentence a file. `kept` are files that are left as they stand.
std::vector<std::string> write_run(const std::filesystem::path& folder, const RunRecord& record,
                                   const std::set<std::string>& kept = {});

}  // namespace tilth
