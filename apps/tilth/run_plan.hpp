// A run as the command line or Python asks for it, and what it is made of before its first scan.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline_choice.hpp"
#include <tilth/core/beam_estimate.hpp>
#include <tilth/localization/localizer.hpp>
#include <tilth/odometry/external_motion.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/run/session.hpp>
#include <tilth/view/view_server.hpp>

namespace tilth::app {

struct RunArguments {
  std::string source, out;
  std::string beams;                        ///< beams.yaml; empty: none
  std::optional<BeamEstimate> found_beams;  ///< by a first pass; in the place of that file
  std::string prior;                        ///< trajectory of another source; empty: none
  std::string save_map;                     ///< folder of the map to save; empty: none
  std::string map_to_continue;              ///< folder of a map; empty: none
  std::string base_from_lidar;              ///< as parse_mount takes it; empty: not known
  std::optional<ViewAddress> view;          ///< nothing: nobody watches
  OptionArguments options;
  OptionValues map, output, report;  ///< of MapOptions, OutputOptions and ReportOptions
  SessionOptions session;
  int threads = 0;  ///< zero: as many as there are processors
  bool loop_closure = false, learn_beams = false, keep_beams = false, level = false, quiet = false;
};

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

}  // namespace tilth::app
