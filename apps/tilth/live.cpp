// tilth live: a sensor's packets, or clouds of a topic, become a trajectory and a map while they come, saved at every
// moment.
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "live_input.hpp"
#include "localize_session.hpp"
#include "locked_folder.hpp"
#include "option_flags.hpp"
#include "run_session.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/run/journal_sink.hpp>
#include <tilth/run/track_record.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth::app {
namespace {

struct LiveArguments : LocalizeArguments {
  OptionValues input;
  double duration = 0.0;     // [s], 0: until it is stopped
  double checkpoint = 30.0;  // [s]
  bool resume = false, force = false;
};

void check_folder(const LiveArguments& arguments) {
  if (arguments.resume || arguments.force || !holds_run(arguments.run.out)) return;
  throw Error(arguments.run.out,
              "holds the trajectory of an earlier run: --resume goes on with it, --force replaces it");
}

/// Whether so many seconds have passed since now; never for zero.
Enough seconds_from_now(double seconds) {
  return [seconds, since = Stopwatch()] { return seconds > 0.0 && since.seconds() > seconds; };
}

std::string reason(RunEnd end, bool enough) {
  if (end != RunEnd::end_of_input) return to_text(end);
  return enough ? "as long as asked for" : "the sensor is silent";
}

/// Goes on with the run in `folder`, at its last pose.
void resume(const std::string& folder, PlannedRun& plan, Console& console) {
  RunRecord& record = plan.record;
  for (const std::string& notice : continue_run(folder, record)) console.warn(notice);
  console.note("resumed: " + std::to_string(record.trajectory.size()) + " poses and " +
               std::to_string(record.map.size()) +
               " points of before; the world stays the same if the sensor has not moved since the last pose");
  if (record.trajectory.empty()) return;
  plan.pipeline.odometry =
      std::make_unique<ContinuedOdometry>(std::move(plan.pipeline.odometry), record.trajectory.back().T_world_lidar);
}

/// The journal, and every file that it does not leave complete.
void add_sinks(Session& session, const LiveArguments& a, const PlannedRun& plan, RunObserver& observer) {
  const std::filesystem::path folder = a.run.out;
  session.add(std::make_unique<JournalSink>(folder, a.checkpoint, observer));
  const std::set<std::string> kept = journal_files(a.run.loop_closure);
  for (const RunOutput& output : plan.outputs) {
    if (!kept.contains(output.file)) session.add(output.open(folder / output.file));
  }
}

/// In a saved map: the folder gets what `tilth localize` writes.
int live_in_map(const LiveArguments& a) {
  if (a.run.learn_beams) throw Error("--learn-beams", "does not go with --map");
  for (const OptionValues& of_map : {a.run.output, a.run.map})
    if (!of_map.empty()) throw Error(flag_of(of_map.begin()->first), "is of a map that is made: with --map none is");
  Console console(a.run.quiet);
  LocalizeSession session(a);
  const LockedFolder folder(a.run.out, session.files());
  check_folder(a);
  remember_interrupts();
  std::unique_ptr<LiveScans> source = open_live(a.run.source, a.input, seconds_from_now(a.duration), console);
  if (!source) return signal_exit_code();
  LiveConsole observer(*source, console);
  const LocalizeSession::End end = session.run(std::move(source), observer, console);
  if (!end.whole) return 1;
  return end.is_known ? 0 : kTrackLostExit;
}

int live(const LiveArguments& a) {
  if (!a.map.empty()) return live_in_map(a);
  Console console(a.run.quiet);
  PlannedRun plan = plan_run(a.run);
  const LockedFolder folder(a.run.out, files_of(plan.outputs));
  check_folder(a);
  remember_interrupts();
  const std::shared_ptr<ViewServer> view = open_view(a.run, console);
  const Enough enough = seconds_from_now(a.duration);
  std::unique_ptr<LiveScans> source = open_live(a.run.source, a.input, enough, console);
  if (!source) return signal_exit_code();
  LiveConsole observer(*source, console);
  std::unique_ptr<ScanSource> scans = corrected_source(std::move(source), a.run, plan);
  if (a.resume && holds_run(a.run.out)) {
    resume(a.run.out, plan, console);
  } else {
    remove_run(a.run.out, files_of(run_outputs(plan.output, plan.report, true)));
    scans = begin_world(std::move(scans), a.run, plan, console);
  }
  const std::size_t before = plan.record.trajectory.size();
  Session session(std::move(scans), std::move(plan.pipeline), std::move(plan.record));
  session.observe(observer);
  add_sinks(session, a, plan, observer);
  if (view) session.add(std::make_unique<ViewSink>(view));
  const RunEnd end = run_session(session, a.run);
  session.record().ended = reason(end, enough());
  const bool whole = tell_end(session.record(), a.run.out, files_of(plan.outputs), session.finish(), console);
  if (!whole || session.record().trajectory.size() == before) return 1;
  return was_lost(session.record().scans) ? kTrackLostExit : 0;
}

}  // namespace

void add_live(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("live", "Turn what a sensor sends into trajectory and map while it comes");
  const auto a = std::make_shared<LiveArguments>();
  a->run.session.interrupted = [] { return interrupted() != 0; };
  command
      ->add_option("SOURCE", a->run.source,
                   "udp://[ADDRESS]:PORT to listen at, as udp://:2368; or ros2:TOPIC with clouds, as ros2:/points")
      ->required();
  command->add_option("--out", a->run.out, "folder for the results; made where missing")->required();
  command->add_flag("--resume", a->resume, "go on with the run in that folder, at its last pose");
  command
      ->add_flag("--loop-closure", a->run.loop_closure,
                 "find places seen before; the way is corrected at the end (loop.*)")
      ->excludes("--resume");
  CLI::Option* map = command->add_option("--map", a->map, "saved map to be found in, as `tilth localize` does");
  map->excludes("--resume", "--loop-closure");
  add_at_flag(*command, *a)->needs(map);
  add_base_flag(*command, a->run);
  add_level_flag(*command, a->run)->excludes("--resume", "--map");
  command->add_flag("--force", a->force, "replace the run in that folder")->excludes("--resume");
  command->add_option("--duration", a->duration, "[s] after which it ends")->check(CLI::PositiveNumber);
  command->add_option("--max-scans", a->run.session.max_scans, "stop after so many scans");
  command->add_option("--checkpoint", a->checkpoint, "[s] between two savings of the map (30)")
      ->check(CLI::Range(0.1, 1e6))
      ->excludes(map);
  command->add_option("--pipeline", a->run.options.pipeline, "see `tilth pipelines`; default: the first of them");
  add_setting_arguments(*command, a->run.options);
  add_live_flags(*command, a->input);
  add_beams_flag(*command, a->run);
  add_learn_beams_flag(*command, a->run);
  add_output_flags(*command, a->run);
  add_view_flags(*command, a->run);
  add_threads_flag(*command, a->run);
  command->add_flag("--quiet", a->run.quiet, "print errors only");
  command->callback([a, &exit_code] { exit_code = live(*a); });
}

}  // namespace tilth::app
