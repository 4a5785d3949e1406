#include "run_session.hpp"

#include <charconv>

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "option_flags.hpp"
#include "run_console.hpp"
#include "threads.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/beam_pipeline.hpp>
#include <tilth/run/level_floor.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/sources/beam_corrected_source.hpp>
#include <tilth/sources/describe_source.hpp>
#include <tilth/sources/lookahead_source.hpp>

namespace tilth::app {
namespace {

constexpr double kLevelSeconds = 2.0;  // [s] of scans that the floor is looked for in

/// The number that follows --view, or `usual` where none does.
std::uint16_t port_of(const std::string& text, std::uint16_t usual) {
  if (text.empty() || text == "true") return usual;
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || end != text.data() + text.size())
    throw Error("--view " + text, "is no port: expected a number from 0 (any that is free) to 65535");
  return port;
}

}  // namespace

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

void add_base_flag(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--base-from-lidar", arguments.base_from_lidar,
                  "where the LiDAR is mounted on the robot: poses are then of base_link, and the map begins there")
      ->option_text("x,y,z,roll,pitch,yaw [m, deg] or x,y,z,qx,qy,qz,qw");
}

CLI::Option* add_level_flag(CLI::App& command, RunArguments& arguments) {
  return command.add_flag("--level", arguments.level,
                          "turn the map so that the floor below the first seconds is level");
}

void add_view_flags(CLI::App& command, RunArguments& arguments) {
  const auto view = [&]() -> ViewAddress& { return arguments.view ? *arguments.view : arguments.view.emplace(); };
  CLI::Option* port = command.add_option_function<std::string>(
      "--view", [view](const std::string& text) { view().port = port_of(text, view().port); },
      "let browsers on this machine and Foxglove watch the run while it goes on");
  port->expected(0, 1)->option_text("[PORT] (8765)");
  command
      .add_option_function<std::string>(
          "--view-host", [view](const std::string& host) { view().host = host; },
          "address to be watched at; 0.0.0.0: from every machine that reaches this one")
      ->needs(port)
      ->option_text("ADDRESS (127.0.0.1)");
}

std::shared_ptr<ViewServer> open_view(const RunArguments& arguments, RunObserver& observer) {
  if (!arguments.view) return nullptr;
  const ViewAddress& wanted = *arguments.view;
  auto server = std::make_shared<ViewServer>(wanted, "Tilth: " + arguments.source);
  if (wanted.port != 0 && server->port() != wanted.port)
    observer.warn("port " + std::to_string(wanted.port) + " is taken");
  const bool six = wanted.host.find(':') != std::string::npos;
  const std::string at = (six ? "[" + wanted.host + "]" : wanted.host) + ":" + std::to_string(server->port());
  observer.note("watch it at http://" + at + "/, in Foxglove at ws://" + at);
  return server;
}
void add_prior_flag(CLI::App& command, RunArguments& arguments) {
  command.add_option("--prior", arguments.prior, kPriorMeaning)->option_text("FILE");
}

PlannedRun plan_run(const RunArguments& arguments, const std::vector<OptionInfo>& source_options,
                    const std::vector<OptionInfo>& source_defaults) {
  const PipelineChoice choice = choose_pipeline(arguments.options);
  PlannedRun plan;
  plan.record = new_record(arguments.source, choice.name, choice.values);
  add_options(source_options, source_defaults, plan.record);
  add_options(describe_beams(arguments.beams, arguments.learn_beams), describe_beams({}, false), plan.record);
  add_options(describe_prior(arguments.prior), describe_prior({}), plan.record);
  add_options(describe_mount(arguments.base_from_lidar, arguments.level), describe_mount("", false), plan.record);
  if (!arguments.base_from_lidar.empty()) plan.record.T_base_lidar = parse_mount(arguments.base_from_lidar);
  if (!arguments.beams.empty()) plan.beams = read_beams(arguments.beams);
  const auto map = with<MapOptions>(arguments.map);
  plan.record.map = MapBuilder(map);
  plan.output = with<OutputOptions>(arguments.output);
  plan.report = with<ReportOptions>(arguments.report);
  const SlamOptions slam = with<SlamOptions>(choice.loop);
  plan.localize = with<LocalizationOptions>(choice.localize).localize;
  const BeamLearning learning = arguments.learn_beams ? BeamLearning::correct : BeamLearning::watch;
  plan.external = read_prior(arguments.prior);
  plan.trial = [choice] { return make_odometry(choice.name, choice.values); };
  plan.pipeline = with_beams(make_odometry(choice.name, choice.values, plan.external), learning, plan.beams);
  const bool loop_closure = arguments.loop_closure || !arguments.save_map.empty();
  if (loop_closure) {
    add_options(describe(slam), describe(SlamOptions{}), plan.record);
    plan.loop_closure = slam;
  }
  plan.outputs = run_outputs(plan.output, plan.report, loop_closure, map.keep_moving);
  return plan;
}

std::unique_ptr<ScanSource> corrected_source(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                             const PlannedRun& plan) {
  return plan.beams ? beam_corrected_source(std::move(source), plan.beams->model, arguments.beams) : std::move(source);
}

std::unique_ptr<ScanSource> begin_world(std::unique_ptr<ScanSource> source, const RunArguments& arguments,
                                        PlannedRun& plan, RunObserver& observer) {
  Pose T_world_lidar = plan.record.T_base_lidar.value_or(Pose::Identity());
  if (arguments.level) {
    auto ahead = std::make_unique<LookaheadSource>(std::move(source), kLevelSeconds);
    const FloorPlane floor = floor_below(*plan.trial(), ahead->ahead(), T_world_lidar);
    observer.note("levelled: " + floor_sentence(floor));
    T_world_lidar = levelling(floor) * T_world_lidar;
    plan.record.floor = floor;
    source = std::move(ahead);
  }
  std::unique_ptr<Odometry>& odometry = plan.pipeline.odometry;
  if (plan.record.T_base_lidar || arguments.level)
    odometry = std::make_unique<ContinuedOdometry>(std::move(odometry), T_world_lidar);
  if (plan.loop_closure) plan.pipeline = with_loop_closure(std::move(plan.pipeline), *plan.loop_closure);
  return source;
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
