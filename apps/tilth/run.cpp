// tilth run: a recording becomes a trajectory, a map and figures.
#include <memory>
#include <optional>

#include "commands.hpp"
#include "interrupt.hpp"
#include "locked_folder.hpp"
#include "loop_closing.hpp"
#include "option_arguments.hpp"
#include "option_flags.hpp"
#include "process.hpp"
#include "register_scans.hpp"
#include "run_report.hpp"
#include "source_flags.hpp"
#include "truth_flags.hpp"
#include <tilth/core/error.hpp>
#include <tilth/evaluation/evaluate.hpp>
#include <tilth/report/write_run.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/truth_file.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

struct RunArguments {
  std::string source, out, truth, calibration;
  OptionArguments options;
  SourceOptions input;
  RecordValues record;
  LoopOptions loop;
  bool loop_closure = false;
  int threads = 0;  // zero: as many as there are processors
  bool quiet = false;
};

/// Registers what `source` has, whatever the end.
RunEnd register_all(const RunArguments& arguments, ScanSource& source, Pipeline& pipeline, RunRecord& record,
                    Console& console) {
  remember_interrupts();
  const Stopwatch stopwatch;
  RegistrationLoop loop(source, *pipeline.odometry, record, console);
  const RunEnd end = with_threads(arguments.threads, [&] { return loop.run(arguments.loop); });
  record.notices = source.notices();
  for (const std::string& notice : record.notices) console.note(notice);
  if (pipeline.slam != nullptr) close_loops(*pipeline.slam, record);
  record.ended = to_text(end);
  record.wall_seconds = stopwatch.seconds();
  record.peak_megabytes = peak_megabytes();
  return end;
}

/// Evaluates the run; what prevents that is returned, one sentence each. Whatever the truth's own frame, the run's
/// world is its first LiDAR pose: so the first poses are made equal.
std::vector<std::string> judge_by(const TruthFile& truth, RunRecord& record) {
  EvaluationOptions options;
  options.align = Alignment::origin;
  options.association.interpolate = truth.poses.has_stamps;  // truth and poses seldom share their stamps
  try {
    record.evaluation = judge(truth, {record.trajectory, true, {}}, options);
  } catch (const Error& e) {
    return {e.what()};
  }
  return {};
}

int exit_code_of(RunEnd end, bool strict) {
  if (end == RunEnd::interrupted) return signal_exit_code();
  return end == RunEnd::bad_record || (end == RunEnd::input_broken && strict) ? 1 : 0;
}

int run(const RunArguments& arguments) {
  Console console(arguments.quiet);
  std::optional<TruthFile> truth;
  if (!arguments.truth.empty()) truth = read_truth(arguments.truth, arguments.calibration);
  const PipelineChoice choice = choose_pipeline(arguments.options);
  RunRecord record = new_record(arguments.source, choice, arguments.record);
  add_options(describe_source(arguments.input), describe_source({}), record);
  const SlamOptions slam = with<SlamOptions>(choice.loop);  // refused where wrong, also where not used
  if (arguments.loop_closure) add_options(describe(slam), describe(SlamOptions{}), record);
  Pipeline pipeline = make_pipeline(choice, arguments.loop_closure);
  const std::unique_ptr<ScanSource> source = open_source(arguments.source, stopped_by_signals(arguments.input));
  const LockedFolder folder(arguments.out, run_files(record.output, arguments.loop_closure));
  begin_mcap(arguments.out, record);
  const RunEnd end = register_all(arguments, *source, pipeline, record, console);
  if (record.trajectory.empty() && end != RunEnd::interrupted) {
    const std::string reason = record.skipped.empty() ? "it is empty" : record.skipped.front().what;
    throw Error(arguments.source, "has no scan that can be used; " + reason);
  }
  std::vector<std::string> failures;
  if (truth) failures = judge_by(*truth, record);
  for (std::string& failure : write_run(arguments.out, record)) failures.push_back(std::move(failure));
  report_run(record, arguments.out, console);
  for (const std::string& failure : failures) console.error(failure);
  return failures.empty() ? exit_code_of(end, arguments.loop.strict) : 1;
}

void add_input_options(CLI::App& command, RunArguments& a) {
  command
      .add_option("SOURCE", a.source,
                  "folder of scans, KITTI sequence, bag, network capture, udp://:PORT or sim://SCENE")
      ->required();
  add_source_flags(command, a.input);
  command.add_option("--max-scans", a.loop.max_scans, "stop after so many scans");
  command.add_flag("--strict", a.loop.strict, "a record that cannot be used ends the run with an error");
}

void add_output_options(CLI::App& command, RunArguments& a) {
  command.add_option("--out", a.out, "folder for the results; made where missing")->required();
  add_option_flags(command, describe(MapOptions{}), a.record.map);
  add_option_flags(command, describe(OutputOptions{}), a.record.output);
  add_option_flags(command, describe(ReportOptions{}), a.record.report);
  add_truth_flags(command, "to judge the run by, first poses made equal", a.truth, a.calibration);
  command.add_flag("--quiet", a.quiet, "print errors only");
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Turn a recording into a trajectory, a map and figures");
  const auto arguments = std::make_shared<RunArguments>();
  add_input_options(*command, *arguments);
  command->add_option("--pipeline", arguments->options.pipeline, "see `tilth pipelines`; default: the first of them");
  command->add_flag("--loop-closure", arguments->loop_closure, "find places seen before and correct the way (loop.*)");
  add_setting_arguments(*command, arguments->options);
  add_output_options(*command, *arguments);
  command->add_option("--threads", arguments->threads, "0: as many as there are processors")
      ->check(CLI::Range(0, 1024));
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace tilth::app
