#include <algorithm>
#include <numbers>

#include <nlohmann/json.hpp>

#include <tilth/evaluation/distribution.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/beam_record.hpp>
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/summary_json.hpp>
#include <tilth/run/track_record.hpp>

namespace tilth {

using Json = nlohmann::ordered_json;

/// Found by the JSON library through its argument's namespace.
static void to_json(Json& json, const Distribution& d) {
  json = {{"mean", d.mean}, {"median", d.median}, {"p99", d.p99}, {"max", d.max}};
}

namespace {

/// The distribution of value(row) over all scans.
template <class F>
Distribution over_scans(const ScanTable& table, const F& value) {
  std::vector<double> values;
  for (const ScanRow& row : table.rows) values.push_back(value(row));
  return distribution_of(std::move(values));
}

Json milliseconds(const ScanTable& table) {
  Json stages = Json::object();
  for (std::size_t i = 0; i < table.stages.size(); ++i) {
    stages[table.stages[i]] =
        over_scans(table, [i](const ScanRow& row) { return i < row.stage_ms.size() ? row.stage_ms[i] : 0.0; });
  }
  return {{"register", over_scans(table, [](const ScanRow& row) { return row.register_ms; })},
          {"register_cpu", over_scans(table, [](const ScanRow& row) { return row.register_cpu_ms; })},
          {"read", over_scans(table, [](const ScanRow& row) { return row.read_ms; })},
          {"build_map", over_scans(table, [](const ScanRow& row) { return row.map_ms; })},
          {"stages", std::move(stages)}};
}

Json counts(const RunRecord& record) {
  const std::vector<ScanRow>& rows = record.scans.rows;
  return {{"scans", rows.size()},
          {"skipped", record.skipped.size()},
          {"not_converged", std::count_if(rows.begin(), rows.end(), [](const ScanRow& r) { return !r.converged; })},
          {"degenerate",
           std::count_if(rows.begin(), rows.end(), [](const ScanRow& r) { return r.degenerate_directions > 0; })},
          {"map_points", record.map.size()},
          {"moving_points", record.map.moving().size()},
          {"points_read", over_scans(record.scans, [](const ScanRow& r) { return double(r.points_read); })},
          {"points_in", over_scans(record.scans, [](const ScanRow& r) { return double(r.points_in); })},
          {"outliers", over_scans(record.scans, [](const ScanRow& r) { return double(r.outliers); })},
          {"edges", over_scans(record.scans, [](const ScanRow& r) { return double(r.edges); })},
          {"planes", over_scans(record.scans, [](const ScanRow& r) { return double(r.planes); })},
          {"matches", over_scans(record.scans, [](const ScanRow& r) { return double(r.matches); })}};
}

Json options(const RunRecord& record) {
  Json values = Json::object();
  for (const OptionInfo& option : record.options) values[option.key] = option.value;
  return values;
}

Json changes(const RunRecord& record) {
  const auto numbers = [](const Eigen::Vector3f& v) { return Json{v.x(), v.y(), v.z()}; };
  Json list = Json::array();
  for (const Change& change : record.map.changes()) {
    list.push_back({{"change", name_of(change.stay.kind)},
                    {"center", numbers(change.box.center())},
                    {"size", numbers(change.box.sizes())},
                    {"points", change.points},
                    {"first_seen", change.stay.first_seen},
                    {"last_seen", change.stay.last_seen}});
  }
  return list;
}

Json skipped(const RunRecord& record) {
  Json list = Json::array();
  for (const SkippedScan& s : record.skipped)
    list.push_back({{"index", s.index}, {"where", s.where}, {"what", s.what}});
  return list;
}

Json track(const ScanTable& table) {
  const auto name = [](auto value) { return names_of(value)[std::size_t(value)]; };
  Json intervals = Json::array();
  for (const TrackInterval& i : track_intervals(table)) {
    intervals.push_back({{"state", name(i.track.state)},
                         {"reason", name(i.track.reason)},
                         {"from", i.from},
                         {"to", i.to},
                         {"first_scan", i.first},
                         {"scans", i.scans}});
  }
  return {{"state", name(track_at_end(table))}, {"lost", was_lost(table)}, {"intervals", std::move(intervals)}};
}

Json loop_closure(const LoopRecord& loops) {
  Json verdicts = Json::object();
  for (const ClosureRow& row : loops.closures) verdicts[row.verdict] = verdicts.value(row.verdict, 0) + 1;
  return {{"keyframes", loops.graph.poses.size()},     {"candidates", loops.closures.size()},
          {"accepted", verdicts.value("accepted", 0)}, {"verdicts", verdicts},
          {"optimizations", loops.optimizations},      {"finish_ms", loops.finish_ms},
          {"detection_ms", loops.times.detection_ms},  {"verification_ms", loops.times.verification_ms},
          {"graph_ms", loops.times.graph_ms},          {"longest_wait_ms", loops.times.longest_wait_ms}};
}

Json localization(const LocalizationRecord& record) {
  Json scans = Json::object(), intervals = Json::array();
  for (const std::string_view name : names_of(MapState{})) scans[std::string(name)] = 0;
  for (const MapStateInterval& i : state_intervals(record)) {
    const std::string name(names_of(i.state)[std::size_t(i.state)]);
    scans[name] = scans[name].get<std::size_t>() + i.scans;
    intervals.push_back({{"state", name}, {"from", i.from}, {"to", i.to}, {"scans", i.scans}});
  }
  return {{"map", record.map},
          {"scans", std::move(scans)},
          {"seconds_to_answer", times_to_answer(record)},
          {"intervals", std::move(intervals)}};
}

Json frames(const RunRecord& record) {
  Json json = {{"poses_of", body_of(record.T_base_lidar)}};
  if (record.T_base_lidar) json["T_base_lidar"] = mount_numbers(*record.T_base_lidar);
  if (const auto& floor = record.floor) {
    json["levelled_by"] = {{"tilt_deg", tilt_of(*floor) * 180 / std::numbers::pi},
                           {"depth_m", floor->depth},
                           {"thickness_m", floor->thickness},
                           {"points", floor->points}};
  }
  return json;
}

}  // namespace

RunFigures figures_of(const RunRecord& record) {
  RunFigures figures;
  figures.register_ms = over_scans(record.scans, [](const ScanRow& row) { return row.register_ms; });
  figures.registering_seconds = 1e-3 * figures.register_ms.mean * double(record.scans.rows.size());
  const Trajectory trajectory = poses_of_base(record.trajectory, record.T_base_lidar);
  if (trajectory.size() < 2) return figures;
  const double between = trajectory.back().stamp - trajectory.front().stamp;
  figures.recorded_seconds = between + between / double(trajectory.size() - 1);
  figures.real_time_factor = figures.recorded_seconds / std::max(figures.registering_seconds, 1e-9);
  figures.distance = path_length(trajectory);
  figures.end_to_start =
      (trajectory.back().T_world_lidar.translation() - trajectory.front().T_world_lidar.translation()).norm();
  return figures;
}

std::string summary_json(const RunRecord& record) {
  const RunFigures figures = figures_of(record);
  Json summary = {{"version", record.version},
                  {"machine", record.machine},
                  {"source", record.source},
                  {"ended", record.ended},
                  {"decisions", record.decisions},
                  {"pipeline", record.pipeline},
                  {"options", options(record)},
                  {"frames", frames(record)},
                  {"map_voxel_m", record.map.voxel()},
                  {"track", track(record.scans)},
                  {"counts", counts(record)},
                  {"changes", changes(record)},
                  {"skipped", skipped(record)},
                  {"notices", record.notices},
                  {"recorded_seconds", figures.recorded_seconds},
                  {"registering_seconds", figures.registering_seconds},
                  {"wall_seconds", record.wall_seconds},
                  {"real_time_factor", figures.real_time_factor},
                  {"milliseconds", milliseconds(record.scans)},
                  {"peak_megabytes", record.peak_megabytes},
                  {"distance_m", figures.distance},
                  {"end_to_start_m", figures.end_to_start}};
  if (record.beams) summary["beams"] = Json::parse(beams_json(*record.beams));
  if (record.loops) summary["loop_closure"] = loop_closure(*record.loops);
  if (record.localization) summary["localization"] = localization(*record.localization);
  if (record.evaluation) summary["evaluation"] = Json::parse(evaluation_json(*record.evaluation));
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tilth
