// Everything that a run has worked out, ready to be written at any moment.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/run/loop_record.hpp>
#include <tilth/run/map_builder.hpp>
#include <tilth/run/output_options.hpp>
#include <tilth/run/run_mcap.hpp>
#include <tilth/run/scan_table.hpp>

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

}  // namespace tilth
