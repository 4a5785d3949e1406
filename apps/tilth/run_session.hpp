// What `tilth run` and `tilth live` share on the command line, and what they tell at the end.
#pragma once

#include <string>
#include <vector>

#include "console.hpp"
#include "option_arguments.hpp"
#include "run_plan.hpp"

namespace CLI {
class Option;
}

namespace tilth::app {

/// Exit code of a run that came to its end, though its track was lost on the way.
constexpr int kTrackLostExit = 3;

/// Of a run that ended so; `lost`: its track was lost on the way, or its place in a map is not known at the end.
int exit_code_of(RunEnd end, bool lost, bool strict);

/// Adds a flag for each option of the map, the files and the report. `arguments` must outlive the command.
void add_output_flags(CLI::App& command, RunArguments& arguments);

/// Adds --threads.
void add_threads_flag(CLI::App& command, RunArguments& arguments);

/// Adds --beams.
void add_beams_flag(CLI::App& command, RunArguments& arguments);

/// Adds --prior.
void add_prior_flag(CLI::App& command, RunArguments& arguments);

/// Adds --learn-beams.
CLI::Option* add_learn_beams_flag(CLI::App& command, RunArguments& arguments);

/// Adds --keep-beams.
CLI::Option* add_keep_beams_flag(CLI::App& command, RunArguments& arguments);

/// Adds --base-from-lidar.
void add_base_flag(CLI::App& command, RunArguments& arguments);

/// Adds --level.
CLI::Option* add_level_flag(CLI::App& command, RunArguments& arguments);

/// Adds --view and --view-host.
void add_view_flags(CLI::App& command, RunArguments& arguments);

/// Tells what came of a run and, after that, what went wrong. Whether nothing did.
bool tell_end(const RunRecord& record, const std::string& folder, const std::vector<std::string>& files,
              const std::vector<std::string>& failures, Console& console);

}  // namespace tilth::app
