#include "run_console.hpp"

#include <cstdio>
#include <filesystem>

#include <tilth/core/counted.hpp>
#include <tilth/run/beam_record.hpp>
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/summary_json.hpp>
#include <tilth/run/track_record.hpp>

namespace tilth::app {
namespace {

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

void report_run(const RunRecord& record, const std::string& folder, const std::vector<std::string>& files,
                Console& console) {
  const RunFigures figures = figures_of(record);
  if (was_lost(record.scans)) console.error(loss_sentence(record.scans));
  console.note("ended: " + record.ended);
  console.note(counts_line(record));
  console.note(path_line(figures));
  if (record.beams) console.note("beams: " + beams_sentence(*record.beams));
  if (record.loops) console.note(loops_line(*record.loops));
  console.note(speed_line(figures, record.peak_megabytes));
  if (record.evaluation) console.note(evaluation_table(*record.evaluation));
  std::string names = "in " + folder + ":";
  for (const std::string& file : files) {
    if (std::filesystem::exists(std::filesystem::path(folder) / file)) names += " " + file;
  }
  console.note(names);
}

}  // namespace tilth::app
