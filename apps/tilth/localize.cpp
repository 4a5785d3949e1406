// tilth localize: where in a saved map a recording was taken.
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "locked_folder.hpp"
#include "run_session.hpp"
#include "source_flags.hpp"
#include "threads.hpp"
#include <tilth/atlas/map_folder.hpp>
#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/report/report_sink.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/file_sinks.hpp>
#include <tilth/run/localization_run.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/sources/beam_corrected_source.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

struct LocalizeArguments {
  RunArguments run;
  std::string map;
  std::vector<double> at;  // x, y, z [m], yaw [deg]; empty: not known
  std::size_t restart_every = 0;
  SourceOptions input;
};

std::vector<RunOutput> localization_outputs(const ReportOptions& report) {
  using Path = std::filesystem::path;
  return {{"trajectory.tum", tum_sink},
          {"localization.csv", localization_sink},
          {"hypotheses.csv", hypotheses_sink},
          {"scans.csv", scan_table_sink},
          {"summary.json", summary_sink},
          {"report.html", [report](const Path& path) { return report_sink(path, report); }}};
}

/// Of the LiDAR: `at` tells of base_link where it is known.
std::optional<Pose> guess_of(const std::vector<double>& at, const std::optional<Pose>& T_base_lidar) {
  if (at.empty()) return std::nullopt;
  const Pose T_map_body(Eigen::Translation3d(at[0], at[1], at[2]) *
                        Eigen::AngleAxisd(at[3] * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()));
  return T_map_body * T_base_lidar.value_or(Pose::Identity());
}

void tell(const RunRecord& record, const std::string& folder, const std::vector<std::string>& files, Console& console) {
  const LocalizationRecord& found = *record.localization;
  for (const MapStateInterval& i : state_intervals(found)) {
    char line[128];
    std::snprintf(line, sizeof line, "%-9s from %.2f s to %.2f s, %zu scans",
                  std::string(names_of(i.state)[std::size_t(i.state)]).c_str(), i.from, i.to, i.scans);
    console.note(line);
  }
  char line[128];
  std::snprintf(line, sizeof line, "%zu of %zu scans have a pose in the map; %.0f MB at most", record.trajectory.size(),
                found.rows.size(), record.peak_megabytes);
  console.note(line);
  std::string names = "in " + folder + ":";
  for (const std::string& file : files) names += " " + file;
  console.note(names);
}

std::unique_ptr<ScanSource> opened_source(const LocalizeArguments& a) {
  std::unique_ptr<ScanSource> source = open_source(a.run.source, stopped_by_signals(a.input));
  if (a.run.beams.empty()) return source;
  return beam_corrected_source(std::move(source), read_beams(a.run.beams).model, a.run.beams);
}

/// Lost when the recording ends, or never found: the program says so.
bool is_known_at_end(const LocalizationRecord& record) {
  return !record.rows.empty() && is_known(record.rows.back().state);
}

int localize_recording(const LocalizeArguments& a) {
  Console console(a.run.quiet);
  const PipelineChoice choice = choose_pipeline(a.run.options);
  const auto options = with<LocalizationOptions>(choice.localize);
  RunRecord record = new_record(a.run.source, choice.name, choice.values);
  add_options(describe(options), describe(LocalizationOptions{}), record);
  add_options(describe_mount(a.run.base_from_lidar, false), describe_mount("", false), record);
  if (!a.run.base_from_lidar.empty()) record.T_base_lidar = parse_mount(a.run.base_from_lidar);
  record.map = MapBuilder(with<MapOptions>(a.run.map));
  const auto report = with<ReportOptions>(a.run.report);
  const MapFolder map(a.map);
  record.localization.emplace().map = a.map;
  const std::vector<RunOutput> outputs = localization_outputs(report);
  const std::unique_ptr<ScanSource> source = opened_source(a);
  const LockedFolder folder(a.run.out, files_of(outputs));
  std::vector<std::unique_ptr<Sink>> sinks;
  for (const RunOutput& output : outputs) sinks.push_back(output.open(folder / output.file));
  Localizer localizer(
      map, [&] { return make_odometry(choice.name, choice.values); }, options.localize,
      guess_of(a.at, record.T_base_lidar));
  LocalizationRunOptions how{a.run.session, a.restart_every};
  how.session.interrupted = [] { return interrupted() != 0; };
  remember_interrupts();
  const RunEnd end = with_threads(a.run.threads, [&] { return localize(*source, localizer, how, console, record); });
  show_map(map, record);
  const std::vector<std::string> failures = finish_all(sinks, record);
  console.clear_progress();
  tell(record, a.run.out, files_of(outputs), console);
  for (const std::string& failure : failures) console.error(failure);
  if (!failures.empty()) return 1;
  return exit_code_of(end, !is_known_at_end(*record.localization), a.run.session.strict);
}

}  // namespace

void add_localize(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("localize", "Find a recording in a saved map, and follow it there");
  const auto a = std::make_shared<LocalizeArguments>();
  command->add_option("SOURCE", a->run.source, "recording, as `tilth run` takes it")->required();
  command->add_option("--map", a->map, "folder of the map (`tilth run --save-map`)")->required();
  command->add_option("--out", a->run.out, "folder for the results; made where missing")->required();
  command->add_option("--at", a->at, "x,y,z,yaw [m, deg] in the map, about where the first scan was taken")
      ->delimiter(',')
      ->expected(4);
  command->add_option("--restart-every", a->restart_every, "forget the place after so many scans, and find it anew");
  add_source_flags(*command, a->input);
  add_beams_flag(*command, a->run);
  add_base_flag(*command, a->run);
  command->add_option("--max-scans", a->run.session.max_scans, "stop after so many scans");
  command->add_flag("--strict", a->run.session.strict, "a record that cannot be used ends the run with an error");
  command->add_option("--pipeline", a->run.options.pipeline, "see `tilth pipelines`; default: the first of them");
  add_setting_arguments(*command, a->run.options);
  add_threads_flag(*command, a->run);
  command->add_flag("--quiet", a->run.quiet, "print errors only");
  command->callback([a, &exit_code] { exit_code = localize_recording(*a); });
}

}  // namespace tilth::app
