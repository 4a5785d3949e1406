#include "localize_session.hpp"

#include <cstdio>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "option_flags.hpp"
#include "threads.hpp"
#include <tilth/atlas/map_folder.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/report/report_sink.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/file_sinks.hpp>
#include <tilth/run/localization_journal.hpp>
#include <tilth/run/localization_run.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/sources/beam_corrected_source.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth::app {
namespace {

/// Written at the end, beside the journal.
std::vector<RunOutput> localization_outputs(const ReportOptions& report) {
  using Path = std::filesystem::path;
  return {{"hypotheses.csv", hypotheses_sink},
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

/// Lost when the recording ends, or never found: the program says so.
bool is_known_at_end(const LocalizationRecord& record) {
  return !record.rows.empty() && is_known(record.rows.back().state);
}

}  // namespace

CLI::Option* add_at_flag(CLI::App& command, LocalizeArguments& arguments) {
  return command
      .add_option("--at", arguments.at, "x,y,z,yaw [m, deg] in the map, about where the first scan was taken")
      ->delimiter(',')
      ->expected(4);
}

struct LocalizeSession::Plan {
  PipelineChoice choice;
  LocalizerOptions options;
  RunRecord record;
  MapFolder map;
  std::vector<RunOutput> outputs;
  std::optional<BeamModel> beams;

  explicit Plan(const LocalizeArguments& a);
};

LocalizeSession::Plan::Plan(const LocalizeArguments& a)
    : choice(choose_pipeline(a.run.options)),
      options(with<LocalizationOptions>(choice.localize).localize),
      record(new_record(a.run.source, choice.name, choice.values)),
      map(a.map),
      outputs(localization_outputs(with<ReportOptions>(a.run.report))) {
  add_options(describe(LocalizationOptions{options}), describe(LocalizationOptions{}), record);
  add_options(describe_mount(a.run.base_from_lidar, false), describe_mount("", false), record);
  if (!a.run.base_from_lidar.empty()) record.T_base_lidar = parse_mount(a.run.base_from_lidar);
  record.map = MapBuilder(with<MapOptions>(a.run.map));
  record.localization.emplace().map = a.map;
  if (!a.run.beams.empty()) beams = read_beams(a.run.beams).model;
}

LocalizeSession::LocalizeSession(const LocalizeArguments& arguments)
    : arguments_(arguments),
      plan_(std::make_unique<Plan>(arguments)),
      files_(kLocalizationFiles.begin(), kLocalizationFiles.end()) {
  for (const RunOutput& output : plan_->outputs) files_.push_back(output.file);
}

LocalizeSession::~LocalizeSession() = default;

LocalizeSession::End LocalizeSession::run(std::unique_ptr<ScanSource> source, RunObserver& observer, Console& console) {
  const RunArguments& a = arguments_.run;
  RunRecord& record = plan_->record;
  const std::filesystem::path folder = a.out;
  if (plan_->beams) source = beam_corrected_source(std::move(source), *plan_->beams, a.beams);
  std::vector<std::unique_ptr<Sink>> while_it_goes_on, at_the_end;
  while_it_goes_on.push_back(std::make_unique<LocalizationJournal>(folder));
  if (const std::shared_ptr<ViewServer> view = open_view(a, console)) {
    show_map(plan_->map, record);
    while_it_goes_on.push_back(std::make_unique<ViewSink>(view));
  }
  for (const RunOutput& output : plan_->outputs) at_the_end.push_back(output.open(folder / output.file));
  const PipelineChoice& choice = plan_->choice;
  Localizer localizer(
      plan_->map, [&] { return make_odometry(choice.name, choice.values); }, plan_->options,
      guess_of(arguments_.at, record.T_base_lidar));
  LocalizationRunOptions how{a.session, arguments_.restart_every, arguments_.restart_when_found, while_it_goes_on};
  how.session.interrupted = [] { return interrupted() != 0; };
  const RunEnd end = with_threads(a.threads, [&] { return localize(*source, localizer, how, observer, record); });
  if (!a.view) show_map(plan_->map, record);
  std::vector<std::string> failures = finish_all(while_it_goes_on, record);
  for (std::string& failure : finish_all(at_the_end, record)) failures.push_back(std::move(failure));
  console.clear_progress();
  tell(record, a.out, files_, console);
  for (const std::string& failure : failures) console.error(failure);
  return {end, failures.empty(), is_known_at_end(*record.localization)};
}

}  // namespace tilth::app
