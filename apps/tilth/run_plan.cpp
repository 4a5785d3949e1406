#include "run_plan.hpp"

#include "motion_prior_file.hpp"
#include "threads.hpp"
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

std::optional<BeamEstimate> known_beams(const RunArguments& arguments) {
  if (arguments.found_beams) return arguments.found_beams;
  return arguments.beams.empty() ? std::nullopt : std::optional(read_beams(arguments.beams));
}

}  // namespace

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
PlannedRun plan_run(const RunArguments& arguments, const std::vector<OptionInfo>& source_options,
                    const std::vector<OptionInfo>& source_defaults) {
  const PipelineChoice choice = choose_pipeline(arguments.options);
  PlannedRun plan;
  plan.record = new_record(arguments.source, choice.name, choice.values);
  add_options(source_options, source_defaults, plan.record);
  add_options(describe_beams(arguments.beams, arguments.learn_beams, arguments.keep_beams),
              describe_beams({}, false, false), plan.record);
  add_options(describe_prior(arguments.prior), describe_prior({}), plan.record);
  add_options(describe_mount(arguments.base_from_lidar, arguments.level), describe_mount("", false), plan.record);
  if (!arguments.base_from_lidar.empty()) plan.record.T_base_lidar = parse_mount(arguments.base_from_lidar);
  plan.beams = known_beams(arguments);
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
  if (!plan.beams) return source;
  const std::string from = arguments.found_beams ? "what a first pass found" : arguments.beams;
  return beam_corrected_source(std::move(source), plan.beams->model, from);
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
  return with_threads(arguments.threads, [&] { return session.run(arguments.session); });
}

}  // namespace tilth::app
