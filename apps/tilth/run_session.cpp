#include "run_session.hpp"

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "option_flags.hpp"
#include "run_console.hpp"
#include "threads.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/sources/beam_corrected_source.hpp>

namespace tilth::app {
namespace {

constexpr const char* kBeams = "file of the errors of the sensor's beams (`tilth calibrate`): every scan is corrected";

std::vector<OptionInfo> describe_beams(const std::string& file) {
  return {{"source.beams", file, "-", kBeams, "text"}};
}

}  // namespace

void add_output_flags(CLI::App& command, RunArguments& arguments) {
  add_option_flags(command, describe(MapOptions{}), arguments.map);
  add_option_flags(command, describe(OutputOptions{}), arguments.output);
  add_option_flags(command, describe(ReportOptions{}), arguments.report);
}

void add_threads_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--threads", arguments.threads, "0: as many as there are processors")->check(CLI::Range(0, 1024));
}

void add_beams_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--beams", arguments.beams, kBeams)->option_text("FILE");
}

PlannedRun plan_run(const RunArguments& arguments, const std::vector<OptionInfo>& source_options,
                    const std::vector<OptionInfo>& source_defaults) {
  const PipelineChoice choice = choose_pipeline(arguments.options);
  PlannedRun plan;
  plan.record = new_record(arguments.source, choice.name, choice.values);
  add_options(source_options, source_defaults, plan.record);
  add_options(describe_beams(arguments.beams), describe_beams({}), plan.record);
  if (!arguments.beams.empty()) plan.beams = read_beams(arguments.beams).model;
  const auto map = with<MapOptions>(arguments.map);
  plan.record.map = MapBuilder(map);
  plan.output = with<OutputOptions>(arguments.output);
  plan.report = with<ReportOptions>(arguments.report);
  const SlamOptions slam = with<SlamOptions>(choice.loop);
  plan.pipeline.odometry = make_odometry(choice.name, choice.values);
  if (arguments.loop_closure) {
    add_options(describe(slam), describe(SlamOptions{}), plan.record);
    plan.pipeline = with_loop_closure(std::move(plan.pipeline.odometry), slam);
  }
  plan.outputs = run_outputs(plan.output, plan.report, arguments.loop_closure);
  if (map.keep_moving) std::erase_if(plan.outputs, [](const RunOutput& output) { return output.file == "moving.pcd"; });
  return plan;
}

std::unique_ptr<ScanSource> corrected_source(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                             const PlannedRun& plan) {
  return plan.beams ? beam_corrected_source(std::move(source), *plan.beams, arguments.beams) : std::move(source);
}

void require_scans(const RunRecord& record, const std::string& source) {
  if (!record.trajectory.empty()) return;
  const std::string reason = record.skipped.empty() ? "it is empty" : record.skipped.front().what;
  throw Error(source, "has no scan that can be used; " + reason);
}

std::vector<std::string> files_of(const std::vector<RunOutput>& outputs) {
  std::vector<std::string> names;
  for (const RunOutput& output : outputs) names.push_back(output.file);
  return names;
}

RunEnd run_session(Session& session, const RunArguments& arguments) {
  SessionOptions options = arguments.session;
  options.interrupted = [] { return interrupted() != 0; };
  return with_threads(arguments.threads, [&] { return session.run(options); });
}

bool end_session(Session& session, const RunArguments& arguments, const PlannedRun& plan, Console& console,
                 std::vector<std::string> failures) {
  for (std::string& failure : session.finish()) failures.push_back(std::move(failure));
  report_run(session.record(), arguments.out, files_of(plan.outputs), console);
  for (const std::string& failure : failures) console.error(failure);
  return failures.empty();
}

}  // namespace tilth::app
