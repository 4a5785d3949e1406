// tilth calibrate: the errors of a sensor's beams from a recording of a drive.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "calibration_options.hpp"
#include "calibration_report.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "run_session.hpp"
#include "source_flags.hpp"
#include "threads.hpp"
#include <tilth/core/counted.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/beam_keyframe_sink.hpp>
#include <tilth/run/ended_run.hpp>
#include <tilth/run/track_record.hpp>
#include <tilth/slam/slam.hpp>
#include <tilth/sources/beam_corrected_source.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

constexpr std::size_t kFewestWindows = 3;  // that can disagree
constexpr std::size_t kMostRings = 256;    // as beams.yaml has them

struct CalibrateArguments {
  RunArguments run;
  std::string prior;
  SourceOptions input;
};

struct Stopped {};

void check_output(const std::filesystem::path& out) {
  namespace fs = std::filesystem;
  if (fs::is_directory(out)) throw Error(out.string(), "is a folder, expected a file to write");
  if (out.has_parent_path() && !fs::is_directory(out.parent_path()))
    throw Error(out.parent_path().string(), "no such folder");
}

bool lost_mostly(const ScanTable& table) {
  const auto lost = [](const ScanRow& row) { return row.track.state == TrackState::lost; };
  return 2 * std::count_if(table.rows.begin(), table.rows.end(), lost) > std::ptrdiff_t(table.rows.size());
}

void require_rings(const GatheredKeyframes& gathered, const std::string& source) {
  if (gathered.rings == 0) throw Error(source, "has scans without rings: nothing tells their beams apart");
  if (gathered.rings > kMostRings)
    throw Error(source, "has " + std::to_string(gathered.rings) + " rings, at most " + std::to_string(kMostRings) +
                            " can be calibrated");
}

void require_windows(const GatheredKeyframes& gathered, const BeamCalibrationOptions& o, const std::string& source) {
  const std::size_t windows = gathered.windows.size(), window = std::size_t(o.window);
  if (windows >= kFewestWindows) return;
  const std::size_t needed = (kFewestWindows - windows - 1) * window + window / 2 + 1;
  const double metres = std::ceil(o.step * double(needed - gathered.left_over));
  throw Error(source, "gives " + counted(windows, "window") + " of " + std::to_string(window) +
                          " keyframes, at least " + std::to_string(kFewestWindows) + " are needed: drive at least " +
                          std::to_string(int(metres)) + " m more");
}

/// What is known before: of a file, or of any sensor.
BeamEstimate known_before(const std::optional<BeamEstimate>& file, const std::string& name,
                          const GatheredKeyframes& gathered, const BeamCalibrationOptions& options) {
  if (!file) return prior_beams(gathered.rings, gathered.bright, options);
  require_beams(file->model, gathered.rings, name);
  return completed(*file, gathered.rings, options);
}

void tell(const BeamCalibration& found, const BeamEstimate& prior, double metres, Console& console) {
  console.note(calibration_table(found, metres));
  for (const std::string& what : not_shown(prior, found.beams)) console.note(what + ": not shown by this drive");
  if (found.believed == 0) console.note(prior.model.ideal() ? "nothing to correct" : "nothing to correct beyond that");
}

/// Runs the recording; whether it came to its end.
bool gather(const CalibrateArguments& a, const GatheredKeyframes& gathered, Session& session) {
  SessionOptions options = a.run.session;
  options.interrupted = [&] { return interrupted() != 0 || (gathered.scans_without_rings > 0 && gathered.rings == 0); };
  with_threads(a.run.threads, [&] { return session.run(options); });
  if (interrupted() != 0) return false;
  require_scans(session.record());
  for (const std::string& failure : session.finish()) throw Error(a.run.source, failure);
  require_rings(gathered, a.run.source);
  return true;
}

/// Nothing where that was interrupted.
std::optional<BeamCalibration> estimate(const CalibrateArguments& a, KeyframeWindows windows, const BeamEstimate& prior,
                                        const BeamCalibrationOptions& options, Console& console) {
  const auto progress = [&](int iteration, int iterations) {
    if (interrupted() != 0) throw Stopped();
    console.show_progress("iteration " + std::to_string(iteration) + " of " + std::to_string(iterations));
  };
  try {
    return with_threads(a.run.threads, [&] { return estimate_beams(std::move(windows), prior, options, progress); });
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

int stopped(const CalibrateArguments& a, Console& console) {
  console.error("interrupted: " + a.run.out + " is not written");
  return signal_exit_code();
}

int calibrate(const CalibrateArguments& a) {
  Console console(a.run.quiet);
  check_output(a.run.out);
  PipelineChoice choice = choose_pipeline(a.run.options);
  const BeamCalibrationOptions options = take_calibration_options(choice.values).calibration;
  with<SlamOptions>(choice.loop);  // of a file for `tilth run`
  std::optional<BeamEstimate> file;
  if (!a.prior.empty()) file = read_beams(a.prior);
  RunRecord record;
  record.source = a.run.source;
  record.map = MapBuilder({.voxel = 10.0, .keep_moving = true});  // nobody asks for it
  Session session(open_source(a.run.source, stopped_by_signals(a.input)), {make_odometry(choice.name, choice.values)},
                  std::move(record));
  session.observe(console);
  GatheredKeyframes gathered;
  session.add(std::make_unique<BeamKeyframeSink>(options, gathered));
  remember_interrupts();
  if (!gather(a, gathered, session)) return stopped(a, console);
  const ScanTable& scans = session.record().scans;
  if (was_lost(scans)) console.error(loss_sentence(scans));
  if (lost_mostly(scans))
    return console.error("nothing to calibrate by: " + a.run.out + " is not written"), kTrackLostExit;
  require_windows(gathered, options, a.run.source);
  const BeamEstimate prior = known_before(file, a.prior, gathered, options);
  const auto found = estimate(a, std::move(gathered.windows), prior, options, console);
  if (!found) return stopped(a, console);
  write_beams(a.run.out, found->beams);
  tell(*found, prior, path_length(session.record().trajectory), console);
  console.note("in " + a.run.out + ": for `tilth run --beams`");
  return 0;
}

}  // namespace

void add_calibrate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("calibrate", "Find the constant errors of a sensor's beams by a drive");
  const auto a = std::make_shared<CalibrateArguments>();
  command->add_option("SOURCE", a->run.source, "recording of the drive, as `tilth run` takes it")->required();
  command->add_option("--out", a->run.out, "file to write: beams.yaml, for `tilth run --beams`")->required();
  command->add_option("--prior", a->prior, "what is known of the beams: a file as this command writes it");
  add_source_flags(*command, a->input);
  command->add_option("--max-scans", a->run.session.max_scans, "stop after so many scans");
  command->add_option("--pipeline", a->run.options.pipeline, "see `tilth pipelines`; default: the first of them");
  add_setting_arguments(*command, a->run.options);
  add_threads_flag(*command, a->run);
  command->add_flag("--quiet", a->run.quiet, "print errors only");
  std::string listing = "Options of --set beside those of the pipeline:\n";
  for (const OptionInfo& row : describe(CalibrationOptions{})) {
    if (!row.advanced) listing += "  " + row.key + " = " + row.value + "  [" + row.unit + "] " + row.meaning + "\n";
  }
  command->footer(listing);
  command->callback([a, &exit_code] { exit_code = calibrate(*a); });
}

}  // namespace tilth::app
