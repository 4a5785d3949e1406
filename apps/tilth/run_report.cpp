#include "run_report.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "machine.hpp"
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/report/write_run.hpp>
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/summary_json.hpp>

namespace tilth::app {
namespace {

std::string counted(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

std::string counts_line(const RunRecord& record) {
  return counted(record.trajectory.size(), "scan") + " registered, " + counted(record.skipped.size(), "record") +
         " skipped, " + counted(record.map.size(), "point") + " in the map";
}

std::string path_line(const RunFigures& figures) {
  char text[128];
  std::snprintf(text, sizeof text, "%.2f m in %.1f s; the end lies %.3f m from the start", figures.distance,
                figures.recorded_seconds, figures.end_to_start);
  return text;
}

std::string loops_line(const LoopRecord& loops) {
  return counted(loops.keyframe_scans.size(), "keyframe") + ", " +
         counted(accepted_scans(loops).size(), "loop closure") + " accepted of " +
         counted(loops.closures.size(), "candidate");
}

std::string speed_line(const RunFigures& figures, double megabytes) {
  char text[160];
  const Distribution& ms = figures.register_ms;
  std::snprintf(text, sizeof text,
                "%.2f ms a scan (median %.2f, p99 %.2f, max %.2f), %.1f x real time, %.0f MB at most", ms.mean,
                ms.median, ms.p99, ms.max, figures.real_time_factor, megabytes);
  return text;
}

}  // namespace

RunRecord new_record(const std::string& source, const PipelineChoice& choice, const RecordValues& values) {
  RunRecord record;
  record.version = TILTH_VERSION;
  record.source = source;
  record.pipeline = choice.name;
  record.machine = machine_name();
  record.options = describe_odometry(choice.name, choice.values);
  record.defaults = describe_odometry(choice.name, {});
  record.map = MapBuilder(with<MapOptions>(values.map));
  record.output = with<OutputOptions>(values.output);
  record.report = with<ReportOptions>(values.report);
  return record;
}

void add_options(std::vector<OptionInfo> options, std::vector<OptionInfo> defaults, RunRecord& record) {
  std::move(options.begin(), options.end(), std::back_inserter(record.options));
  std::move(defaults.begin(), defaults.end(), std::back_inserter(record.defaults));
}

void report_run(const RunRecord& record, const std::string& folder, Console& console) {
  const RunFigures figures = figures_of(record);
  console.note("ended: " + record.ended);
  console.note(counts_line(record));
  console.note(path_line(figures));
  if (record.loops) console.note(loops_line(*record.loops));
  console.note(speed_line(figures, record.peak_megabytes));
  if (record.evaluation) console.note(evaluation_table(*record.evaluation));
  std::string files = "in " + folder + ":";
  for (const std::string& file : run_files(record.output, record.loops.has_value())) files += " " + file;
  console.note(files);
}

}  // namespace tilth::app
