// tilth run: a recording becomes a trajectory, a map and figures.
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "locked_folder.hpp"
#include "run_session.hpp"
#include "source_flags.hpp"
#include "truth_flags.hpp"
#include <tilth/run/ended_run.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/run/track_record.hpp>
#include <tilth/run/truth_file.hpp>
#include <tilth/sources/describe_source.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth::app {
namespace {

struct RecordingArguments {
  RunArguments run;
  std::string truth, calibration;
  SourceOptions input;
};

SavedMapPlan saved_map(const RunArguments& run, const PlannedRun& plan, const LockedFolder& folder) {
  const auto beams = plan.beams ? std::optional(plan.beams->model) : std::nullopt;
  return {run.save_map, run.map_to_continue, plan.localize, beams, folder / "map_changes.csv"};
}

int run(const RecordingArguments& a) {
  Console console(a.run.quiet);
  std::optional<TruthFile> truth;
  if (!a.truth.empty()) truth = read_truth(a.truth, a.calibration);
  PlannedRun plan = plan_run(a.run, describe_source(a.input), describe_source({}));
  const std::shared_ptr<ViewServer> view = open_view(a.run, console);
  std::unique_ptr<ScanSource> source =
      corrected_source(open_source(a.run.source, stopped_by_signals(a.input)), a.run, plan);
  source = begin_world(std::move(source), a.run, plan, console);
  const Slam* const slam = plan.pipeline.slam;
  Session session(std::move(source), std::move(plan.pipeline), std::move(plan.record));
  session.observe(console);
  const LockedFolder folder(a.run.out, files_of(plan.outputs));
  for (const RunOutput& output : plan.outputs) session.add(output.open(folder / output.file));
  if (view) session.add(std::make_unique<ViewSink>(view));
  if (!a.run.save_map.empty()) session.add(saved_map_sink(saved_map(a.run, plan, folder), *slam));
  remember_interrupts();
  const RunEnd end = run_session(session, a.run);
  const RunRecord& record = session.record();
  if (end != RunEnd::interrupted) require_scans(record);
  std::vector<std::string> failures;
  if (truth) failures = judge_by(*truth, session.record());
  if (plan.external) notice_prior(*plan.external, a.run.prior, session.record(), console);
  const bool whole = end_session(session, a.run, plan, console, std::move(failures));
  return whole ? exit_code_of(end, was_lost(record.scans), a.run.session.strict) : 1;
}

void add_input_options(CLI::App& command, RecordingArguments& a) {
  command
      .add_option("SOURCE", a.run.source,
                  "folder of scans, KITTI sequence, bag, network capture, udp://:PORT or sim://SCENE")
      ->required();
  add_source_flags(command, a.input);
  add_beams_flag(command, a.run);
  add_learn_beams_flag(command, a.run);
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
  add_input_options(*command, *a);
  command->add_option("--pipeline", a->run.options.pipeline, "see `tilth pipelines`; default: the first of them");
  command->add_flag("--loop-closure", a->run.loop_closure, "find places seen before and correct the way (loop.*)");
  add_setting_arguments(*command, a->run.options);
  add_output_options(*command, *a);
  add_threads_flag(*command, a->run);
  command->callback([a, &exit_code] { exit_code = run(*a); });
}

}  // namespace tilth::app
