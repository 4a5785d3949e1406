// tilth live: a sensor's packets become a trajectory and a map while they come, saved at every moment.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "interrupt.hpp"
#include "locked_folder.hpp"
#include "loop_closing.hpp"
#include "option_arguments.hpp"
#include "option_flags.hpp"
#include "process.hpp"
#include "register_scans.hpp"
#include "run_report.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/report/write_run.hpp>
#include <tilth/run/run_journal.hpp>
#include <tilth/sources/live_source.hpp>

namespace tilth::app {
namespace {

struct LiveArguments {
  std::string source, out;
  OptionArguments options;
  OptionValues input;
  RecordValues record;
  LoopOptions loop;
  double duration = 0.0;     // [s], 0: until it is stopped
  double checkpoint = 30.0;  // [s]
  int threads = 0;           // zero: as many as there are processors
  bool loop_closure = false, resume = false, force = false, quiet = false;
};

/// What is to be done after every scan.
class Keeper {
 public:
  Keeper(const LiveArguments& arguments, const LiveSource& source, RunJournal& journal, Console& console)
      : arguments_(arguments), source_(source), journal_(journal), console_(console) {}

  void keep(const RunRecord& record) {
    journal_.append(record);
    tell_drops();
    if (checkpoint_.seconds() < arguments_.checkpoint) return;
    checkpoint_ = Stopwatch();
    const std::string problem = journal_.checkpoint(record);
    if (!problem.empty()) console_.warn("the last checkpoint could not be written: " + problem);
    console_.note(std::to_string(record.trajectory.size()) + " scans registered, " + std::to_string(record.map.size()) +
                  " points in the map");
  }

 private:
  void tell_drops() {
    constexpr double kSecondsBetweenTellings = 1.0;
    const LiveCounts counts = source_.counts();
    const std::size_t packets = counts.packets.dropped + counts.packets.system_dropped;
    if (counts.dropped + packets == told_ || telling_.seconds() < kSecondsBetweenTellings) return;
    told_ = counts.dropped + packets;
    telling_ = Stopwatch();
    console_.warn("this computer is too slow: " + std::to_string(counts.dropped) + " of " +
                  std::to_string(counts.scans) + " scans and " + std::to_string(packets) + " packets dropped so far");
  }

  const LiveArguments& arguments_;
  const LiveSource& source_;
  RunJournal& journal_;
  Console& console_;
  Stopwatch checkpoint_, telling_;
  std::size_t told_ = 0;
};

void check_folder(const LiveArguments& arguments) {
  if (arguments.resume || arguments.force || !holds_run(arguments.out)) return;
  throw Error(arguments.out, "holds the trajectory of an earlier run: --resume goes on with it, --force replaces it");
}

/// Listens and waits for the sensor; nothing where that was interrupted.
std::unique_ptr<LiveSource> open(const LiveArguments& arguments, std::function<bool()> stopped, Console& console) {
  const LiveAddress address = parse_live_uri(arguments.source, arguments.input);
  std::unique_ptr<PacketReceiver> receiver = listen(address, std::move(stopped));
  console.note("listening at " + receiver->name() + "; Ctrl-C ends it");
  if (!receiver->warning().empty()) console.warn(receiver->warning());
  try {
    return std::make_unique<LiveSource>(std::move(receiver), address.options);
  } catch (const Error&) {
    if (interrupted() == 0) throw;
    return nullptr;
  }
}

/// `odometry`, at the last pose of the run that `record` goes on with.
std::unique_ptr<Odometry> continued(std::unique_ptr<Odometry> odometry, const RunRecord& record) {
  if (record.trajectory.empty()) return odometry;
  return std::make_unique<ContinuedOdometry>(std::move(odometry), record.trajectory.back().T_world_lidar);
}

std::string reason(RunEnd end, bool enough) {
  if (end != RunEnd::end_of_input) return to_text(end);
  return enough ? "as long as asked for" : "no more packets";
}

void resume(const LiveArguments& arguments, RunRecord& record, Console& console) {
  for (const std::string& notice : continue_run(arguments.out, record)) console.warn(notice);
  console.note("resumed: " + std::to_string(record.trajectory.size()) + " poses and " +
               std::to_string(record.map.size()) +
               " points of before; the world stays the same if the sensor has not " + "moved since the last pose");
}

int live(const LiveArguments& arguments) {
  Console console(arguments.quiet);
  const PipelineChoice choice = choose_pipeline(arguments.options);
  RunRecord record = new_record(arguments.source, choice, arguments.record);
  const SlamOptions slam = with<SlamOptions>(choice.loop);  // refused where wrong, also where not used
  if (arguments.loop_closure) add_options(describe(slam), describe(SlamOptions{}), record);
  Pipeline pipeline = make_pipeline(choice, arguments.loop_closure);
  const LockedFolder folder(arguments.out, run_files(record.output, arguments.loop_closure));
  check_folder(arguments);
  remember_interrupts();
  const Stopwatch stopwatch;
  const auto enough = [&] { return arguments.duration > 0.0 && stopwatch.seconds() > arguments.duration; };
  const auto source = open(
      arguments, [&] { return interrupted() != 0 || enough(); }, console);
  if (!source) return signal_exit_code();
  const bool continues = arguments.resume && holds_run(arguments.out);
  if (continues) resume(arguments, record, console);
  RunJournal journal(arguments.out, run_files(record.output, true), !continues);
  begin_mcap(arguments.out, record);
  const std::unique_ptr<Odometry> odometry = continued(std::move(pipeline.odometry), record);
  Keeper keeper(arguments, *source, journal, console);
  RegistrationLoop loop(*source, *odometry, record, console);
  LoopOptions options = arguments.loop;
  options.registered = [&] { keeper.keep(record); };
  const std::size_t before = record.trajectory.size();
  record.ended = "it goes on";
  const RunEnd end = with_threads(arguments.threads, [&] { return loop.run(options); });
  record.ended = reason(end, enough());
  record.notices = source->notices();
  for (const std::string& notice : record.notices) console.note(notice);
  if (pipeline.slam != nullptr) close_loops(*pipeline.slam, record);
  record.wall_seconds = stopwatch.seconds();
  record.peak_megabytes = peak_megabytes();
  std::vector<std::string> failures = journal.finish(record);
  for (std::string& failure : write_run(arguments.out, record, RunJournal::kept(record)))
    failures.push_back(std::move(failure));
  report_run(record, arguments.out, console);
  for (const std::string& failure : failures) console.error(failure);
  return failures.empty() && record.trajectory.size() > before ? 0 : 1;
}

}  // namespace

void add_live(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("live", "Turn a sensor's packets into trajectory and map while they come");
  const auto a = std::make_shared<LiveArguments>();
  command->add_option("SOURCE", a->source, "udp://[ADDRESS]:PORT to listen at, as udp://:2368")->required();
  command->add_option("--out", a->out, "folder for the results; made where missing")->required();
  command->add_flag("--resume", a->resume, "go on with the run in that folder, at its last pose");
  command
      ->add_flag("--loop-closure", a->loop_closure, "find places seen before; the way is corrected at the end (loop.*)")
      ->excludes("--resume");
  command->add_flag("--force", a->force, "replace the run in that folder")->excludes("--resume");
  command->add_option("--duration", a->duration, "[s] after which it ends")->check(CLI::PositiveNumber);
  command->add_option("--max-scans", a->loop.max_scans, "stop after so many scans");
  command->add_option("--checkpoint", a->checkpoint, "[s] between two savings of the map (30)")
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--pipeline", a->options.pipeline, "see `tilth pipelines`; default: the first of them");
  add_setting_arguments(*command, a->options);
  add_option_flags(*command, describe(LiveOptions{}), a->input);
  add_option_flags(*command, describe(MapOptions{}), a->record.map);
  add_option_flags(*command, describe(OutputOptions{}), a->record.output);
  add_option_flags(*command, describe(ReportOptions{}), a->record.report);
  command->add_option("--threads", a->threads, "0: as many as there are processors")->check(CLI::Range(0, 1024));
  command->add_flag("--quiet", a->quiet, "print errors only");
  command->callback([a, &exit_code] { exit_code = live(*a); });
}

}  // namespace tilth::app
