#include "run_session.hpp"

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "option_flags.hpp"
#include "run_console.hpp"
#include "threads.hpp"
#include <tilth/io/beam_file.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/odometry/external_motion.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/beam_pipeline.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/sources/beam_corrected_source.hpp>
#include <tilth/sources/describe_source.hpp>

namespace tilth::app {

int exit_code_of(RunEnd end, bool lost, bool strict) {
  if (end == RunEnd::interrupted) return signal_exit_code();
  if (end == RunEnd::bad_record || ((end == RunEnd::input_broken || lost) && strict)) return 1;
  return lost ? kTrackLostExit : 0;
}

void add_output_flags(CLI::App& command, RunArguments& arguments) {
  add_option_flags(command, describe(MapOptions{}), arguments.map);
  add_option_flags(command, describe(OutputOptions{}), arguments.output);
  add_option_flags(command, describe(ReportOptions{}), arguments.report);
}

void add_threads_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--threads", arguments.threads, "0: as many as there are processors")->check(CLI::Range(0, 1024));
}

void add_beams_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--beams", arguments.beams, kBeamsMeaning)->option_text("FILE");
}

void add_learn_beams_flag(CLI::App& command, RunArguments& arguments) {
  command.add_flag("--learn-beams", arguments.learn_beams, kLearnBeamsMeaning);
}

void add_prior_flag(CLI::App& command, RunArguments& arguments) {
  command
      .add_option(
          "--prior", arguments.prior,
          "trajectory of the LiDAR by another source (wheels, an IMU, another odometry), by the clock of the scans")
      ->option_text("FILE");
}

namespace {

std::shared_ptr<const ExternalMotion> external_motion(const std::string& file) {
  if (file.empty()) return nullptr;
  const PoseFile poses = read_pose_file(file);
  if (!poses.has_stamps) throw Error(file, "has no stamps, by which a prior is held against the scans");
  return std::make_shared<ExternalMotion>(poses.trajectory);
}

}  // namespace

PlannedRun plan_run(const RunArguments& arguments, const std::vector<OptionInfo>& source_options,
                    const std::vector<OptionInfo>& source_defaults) {
  const PipelineChoice choice = choose_pipeline(arguments.options);
  PlannedRun plan;
  plan.record = new_record(arguments.source, choice.name, choice.values);
  add_options(source_options, source_defaults, plan.record);
  add_options(describe_beams(arguments.beams, arguments.learn_beams), describe_beams({}, false), plan.record);
  if (!arguments.beams.empty()) plan.beams = read_beams(arguments.beams);
  const auto map = with<MapOptions>(arguments.map);
  plan.record.map = MapBuilder(map);
  plan.output = with<OutputOptions>(arguments.output);
  plan.report = with<ReportOptions>(arguments.report);
  const SlamOptions slam = with<SlamOptions>(choice.loop);
  plan.localize = with<LocalizationOptions>(choice.localize).localize;
  const BeamLearning learning = arguments.learn_beams ? BeamLearning::correct : BeamLearning::watch;
  plan.pipeline =
      with_beams(make_odometry(choice.name, choice.values, external_motion(arguments.prior)), learning, plan.beams);
  const bool loop_closure = arguments.loop_closure || !arguments.save_map.empty();
  if (loop_closure) {
    add_options(describe(slam), describe(SlamOptions{}), plan.record);
    plan.pipeline = with_loop_closure(std::move(plan.pipeline), slam);
  }
  plan.outputs = run_outputs(plan.output, plan.report, loop_closure, map.keep_moving);
  return plan;
}

std::unique_ptr<ScanSource> corrected_source(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                             const PlannedRun& plan) {
  return plan.beams ? beam_corrected_source(std::move(source), plan.beams->model, arguments.beams) : std::move(source);
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
