// What `tilth run` and `tilth live` share: the same session, with other sources and sinks.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "motion_prior_file.hpp"
#include "option_arguments.hpp"
#include <tilth/core/beam_estimate.hpp>
#include <tilth/localization/localizer.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/run/session.hpp>
#include <tilth/view/view_server.hpp>

namespace CLI {
class Option;
}

namespace tilth::app {

/// Exit code of a run that came to its end, though its track was lost on the way.
constexpr int kTrackLostExit = 3;

/// Of a run that ended so; `lost`: its track was lost on the way, or its place in a map is not known at the end.
int exit_code_of(RunEnd end, bool lost, bool strict);

struct RunArguments {
  std::string source, out;
  std::string beams;                ///< beams.yaml; empty: none
  std::string prior;                ///< trajectory of another source; empty: none
  std::string save_map;             ///< folder of the map to save; empty: none
  std::string map_to_continue;      ///< folder of a map; empty: none
  std::string base_from_lidar;      ///< as parse_mount takes it; empty: not known
  std::optional<ViewAddress> view;  ///< nothing: nobody watches
  OptionArguments options;
  OptionValues map, output, report;  ///< of MapOptions, OutputOptions and ReportOptions
  SessionOptions session;
  int threads = 0;  ///< zero: as many as there are processors
  bool loop_closure = false, learn_beams = false, level = false, quiet = false;
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

/// Adds --base-from-lidar.
void add_base_flag(CLI::App& command, RunArguments& arguments);

/// Adds --level.
CLI::Option* add_level_flag(CLI::App& command, RunArguments& arguments);

/// Adds --view and --view-host.
void add_view_flags(CLI::App& command, RunArguments& arguments);

/// The server for those who watch, and where it is to be found; nothing where nobody is to.
std::shared_ptr<ViewServer> open_view(const RunArguments& arguments, RunObserver& observer);

/// A run before its first scan.
struct PlannedRun {
  RunRecord record;
  Pipeline pipeline;                                 ///< without loop closure until begin_world()
  std::function<std::unique_ptr<Odometry>()> trial;  ///< another one, for what is to be known beforehand
  std::optional<SlamOptions> loop_closure;
  OutputOptions output;
  ReportOptions report;
  std::vector<RunOutput> outputs;
  std::optional<BeamEstimate> beams;               ///< that every scan is corrected by
  std::shared_ptr<const ExternalMotion> external;  ///< of --prior; or none
  LocalizerOptions localize;                       ///< in a map that the run goes on with
};

/// The run that is asked for; `source_options` are told in its record, with their defaults. Throws Error on an option
/// that is wrong, also on one of loop closure that is not used.
PlannedRun plan_run(const RunArguments& arguments, const std::vector<OptionInfo>& source_options = {},
                    const std::vector<OptionInfo>& source_defaults = {});

/// `source`, its scans corrected where the run has --beams.
std::unique_ptr<ScanSource> corrected_source(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                             const PlannedRun& plan);

/// Lets the world begin at base_link where it is known and, with --level, upright; then closes loops, where it does.
/// What of the source was looked at is still to come. Throws Error where the first seconds show no floor.
std::unique_ptr<ScanSource> begin_world(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                        PlannedRun& plan, RunObserver& observer);

/// The names of the files.
std::vector<std::string> files_of(const std::vector<RunOutput>& outputs);

/// Runs the session to its end or the first interrupt, with as many threads as asked for.
RunEnd run_session(Session& session, const RunArguments& arguments);

/// Writes every file, tells what came of the run and, after `failures`, what went wrong. Whether nothing did.
bool end_session(Session& session, const RunArguments& arguments, const PlannedRun& plan, Console& console,
                 std::vector<std::string> failures = {});

}  // namespace tilth::app
