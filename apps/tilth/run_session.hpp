// What `tilth run` and `tilth live` share: the same session, with other sources and sinks.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "option_arguments.hpp"
#include <tilth/core/beam_estimate.hpp>
#include <tilth/localization/localizer.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/run/session.hpp>

namespace tilth::app {

/// Exit code of a run that came to its end, though its track was lost on the way.
constexpr int kTrackLostExit = 3;

/// Of a run that ended so; `lost`: its track was lost on the way, or its place in a map is not known at the end.
int exit_code_of(RunEnd end, bool lost, bool strict);

struct RunArguments {
  std::string source, out;
  std::string beams;            ///< beams.yaml; empty: none
  std::string prior;            ///< trajectory of another source; empty: none
  std::string save_map;         ///< folder of the map to save; empty: none
  std::string map_to_continue;  ///< folder of a map; empty: none
  OptionArguments options;
  OptionValues map, output, report;  ///< of MapOptions, OutputOptions and ReportOptions
  SessionOptions session;
  int threads = 0;  ///< zero: as many as there are processors
  bool loop_closure = false, learn_beams = false, quiet = false;
};

/// Adds a flag for each option of the map, the files and the report. `arguments` must outlive the command.
void add_output_flags(CLI::App& command, RunArguments& arguments);

/// Adds --threads.
void add_threads_flag(CLI::App& command, RunArguments& arguments);

/// Adds --beams.
void add_beams_flag(CLI::App& command, RunArguments& arguments);

/// Adds --prior.
void add_prior_flag(CLI::App& command, RunArguments& arguments);

/// Adds --learn-beams.
void add_learn_beams_flag(CLI::App& command, RunArguments& arguments);

/// A run before its first scan.
struct PlannedRun {
  RunRecord record;
  Pipeline pipeline;
  OutputOptions output;
  ReportOptions report;
  std::vector<RunOutput> outputs;
  std::optional<BeamEstimate> beams;  ///< that every scan is corrected by
  LocalizerOptions localize;          ///< in a map that the run goes on with
};

/// The run that is asked for; `source_options` are told in its record, with their defaults. Throws Error on an option
/// that is wrong, also on one of loop closure that is not used.
PlannedRun plan_run(const RunArguments& arguments, const std::vector<OptionInfo>& source_options = {},
                    const std::vector<OptionInfo>& source_defaults = {});

/// `source`, its scans corrected where the run has --beams.
std::unique_ptr<ScanSource> corrected_source(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                             const PlannedRun& plan);

/// The names of the files.
std::vector<std::string> files_of(const std::vector<RunOutput>& outputs);

/// Runs the session to its end or the first interrupt, with as many threads as asked for.
RunEnd run_session(Session& session, const RunArguments& arguments);

/// Writes every file, tells what came of the run and, after `failures`, what went wrong. Whether nothing did.
bool end_session(Session& session, const RunArguments& arguments, const PlannedRun& plan, Console& console,
                 std::vector<std::string> failures = {});

}  // namespace tilth::app
