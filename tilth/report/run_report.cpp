#include <cstdarg>
#include <cstdio>

#include <tilth/report/run_report.hpp>
#include <tilth/report/run_sections.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/summary_json.hpp>
#include <tilth/run/track_record.hpp>

namespace tilth {
namespace {

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char buffer[128];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

/// "corridor" of "recordings/corridor/".
std::string last_part(std::string source) {
  while (source.size() > 1 && source.back() == '/') source.pop_back();
  return source.substr(source.find_last_of('/') + 1);
}

std::vector<Fact> facts_of(const RunRecord& record, const std::optional<JudgedRun>& judged) {
  const RunFigures figures = figures_of(record);
  std::vector<Fact> facts{{"scans", std::to_string(record.scans.rows.size())},
                          {"distance", text("%.2f m", figures.distance)},
                          {"duration", text("%.1f s", figures.recorded_seconds)},
                          {"a scan takes, median", text("%.2f ms", figures.register_ms.median)},
                          {"real time", text("%.1f ×", figures.real_time_factor)},
                          {"map", text("%.3g M points", 1e-6 * double(record.map.size()))}};
  if (judged) {
    facts.push_back({"APE, RMSE", text("%.4f m", judged->aligned.ape.translation.rmse)});
    facts.push_back({"APE, max", text("%.4f m", judged->aligned.ape.translation.max)});
  } else {
    facts.push_back({"end to start", text("%.3f m", figures.end_to_start)});
  }
  if (record.loops) {
    facts.push_back({"keyframes", std::to_string(record.loops->keyframe_scans.size())});
    facts.push_back({"loop closures", std::to_string(accepted_scans(*record.loops).size()) + " of " +
                                          std::to_string(record.loops->closures.size()) + " candidates"});
  }
  return facts;
}

void add_loops(const LoopRecord& loops, const std::optional<Pose>& T_base_lidar, MapView& map) {
  map.paths.push_back({kBeforeLoops, poses_of_base(loops.odometry, T_base_lidar), false});
  map.keyframes = loops.keyframe_scans;
  map.closures = accepted_scans(loops);
}

/// Where the track was lost, in every plot over time.
void mark_losses(const ScanTable& scans, std::vector<Section>& sections) {
  Alarm lost{"track lost", {}};
  for (const TrackLoss& loss : track_losses(scans))
    lost.spans.emplace_back(loss.from - scans.rows.front().stamp, loss.to - scans.rows.front().stamp);
  if (lost.spans.empty()) return;
  for (Section& section : sections) {
    for (Plot& plot : section.plots)
      if (plot.over_time) plot.alarm = lost;
  }
}

}  // namespace

Report report_of(const RunRecord& record, std::size_t map_points) {
  std::optional<JudgedRun> judged_run;
  if (record.evaluation) judged_run = judged(*record.evaluation);
  Report report;
  report.title = last_part(record.source);
  report.subtitle = "Trajectory and map by the pipeline " + record.pipeline + " of Tilth " + record.version;
  report.alarm = loss_sentence(record.scans);
  report.facts = facts_of(record, judged_run);
  if (judged_run) report.notes = notices_of(judged_run->aligned);
  report.map = MapView{pack_map(record.map.points(), map_points),
                       pack_map(record.map.moving(), std::min(map_points, kOneLayer)),
                       {{record.pipeline, poses_of_base(record.trajectory, record.T_base_lidar), false}},
                       {},
                       {}};
  if (record.loops) add_loops(*record.loops, record.T_base_lidar, *report.map);
  if (judged_run) report.map->paths.push_back({"truth", judged_run->truth_in_world, true});
  report.sections.push_back(path_section(record, judged_run));
  if (judged_run) report.sections.push_back(accuracy_section(record, *judged_run));
  if (record.beams) report.sections.push_back(beams_section(*record.beams));
  for (const auto& section :
       {quality_section, changes_section, time_section, registration_section, confidence_section, setup_section}) {
    report.sections.push_back(section(record));
  }
  mark_losses(record.scans, report.sections);
  return report;
}

}  // namespace tilth
