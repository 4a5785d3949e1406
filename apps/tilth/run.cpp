// tilth run: a recording becomes a trajectory, a map and figures.
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "recording_run.hpp"
#include "run_session.hpp"
#include "source_flags.hpp"
#include "truth_flags.hpp"
#include <tilth/run/track_record.hpp>

namespace tilth::app {
namespace {

int run(const RecordingArguments& a) {
  Console console(a.run.quiet);
  RecordingRun recording(a, console);
  remember_interrupts();
  const RunOutcome outcome = recording.run();
  const bool whole = tell_end(outcome.record, a.run.out, outcome.files, outcome.failures, console);
  return whole ? exit_code_of(outcome.end, was_lost(outcome.record.scans), a.run.session.strict) : 1;
}

void add_input_options(CLI::App& command, RecordingArguments& a) {
  command
      .add_option("SOURCE", a.run.source,
                  "folder of scans, KITTI sequence, bag, network capture, udp://:PORT or sim://SCENE")
      ->required();
  add_source_flags(command, a.input);
  add_beams_flag(command, a.run);
  add_keep_beams_flag(command, a.run)->excludes(add_learn_beams_flag(command, a.run));
  add_base_flag(command, a.run);
  add_prior_flag(command, a.run);
  command.add_option("--max-scans", a.run.session.max_scans, "stop after so many scans");
  command.add_flag("--strict", a.run.session.strict, "a record that cannot be used ends the run with an error");
}

void add_output_options(CLI::App& command, RecordingArguments& a) {
  command.add_option("--out", a.run.out, "folder for the results; made where missing")->required();
  command.add_option("--save-map", a.run.save_map,
                     "folder for the map, for `tilth localize`; closes loops as --loop-closure does");
  CLI::Option* level = add_level_flag(command, a.run);
  command
      .add_option("--map", a.run.map_to_continue,
                  "map that the one to save goes on with: in its frame, with what is new and what has changed")
      ->needs("--save-map")
      ->excludes(level);
  add_output_flags(command, a.run);
  add_view_flags(command, a.run);
  add_truth_flags(command, "to judge the run by, first poses made equal", a.truth, a.calibration);
  command.add_flag("--quiet", a.run.quiet, "print errors only");
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Turn a recording into a trajectory, a map and figures");
  const auto a = std::make_shared<RecordingArguments>();
  a->run.session.interrupted = [] { return interrupted() != 0; };
  add_input_options(*command, *a);
  command->add_option("--pipeline", a->run.options.pipeline, "see `tilth pipelines`; default: the first of them");
  command->add_flag("--loop-closure", a->run.loop_closure, "find places seen before and correct the way (loop.*)");
  add_setting_arguments(*command, a->run.options);
  add_output_options(*command, *a);
  add_threads_flag(*command, a->run);
  command->callback([a, &exit_code] { exit_code = run(*a); });
}

}  // namespace tilth::app
