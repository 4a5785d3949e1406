#include <numbers>

#include <nlohmann/json.hpp>

#include <tilth/run/evaluation_report.hpp>

namespace tilth {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian

Json to_json(const Metric& metric, const char* unit) {
  return {{"rmse", metric.rmse}, {"mean", metric.mean}, {"median", metric.median}, {"std", metric.std},
          {"min", metric.min},   {"max", metric.max},   {"sse", metric.sse},       {"unit", unit}};
}

Json to_json(const PoseErrors& errors) {
  return {{"translation", to_json(errors.translation, "m")},
          {"rotation", to_json(scaled(errors.rotation, kDegrees), "deg")},
          {"rotation_rad", to_json(errors.rotation, "rad")},
          {"full", to_json(errors.full, "-")}};
}

Json to_json(const Similarity& S, Alignment method) {
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) rotation.push_back({S.rotation(row, 0), S.rotation(row, 1), S.rotation(row, 2)});
  return {{"method", names_of(method)[std::size_t(method)]},
          {"scale", S.scale},
          {"rotation", std::move(rotation)},
          {"translation", {S.translation.x(), S.translation.y(), S.translation.z()}}};
}

Json drift(double translation, double rotation) {
  return {{"translation_percent", 100 * translation}, {"rotation_deg_per_m", kDegrees * rotation}};
}

Json to_json(const KittiMetric& metric) {
  Json json = drift(metric.translation, metric.rotation);
  json["segments"] = metric.segments.size();
  json["by_length"] = Json::array();
  for (const SegmentError& mean : metric.by_length) {
    Json row = drift(mean.translation, mean.rotation);
    row["length"] = mean.length;
    json["by_length"].push_back(std::move(row));
  }
  return json;
}

Json to_json(const std::vector<TruthGap>& gaps) {
  Json list = Json::array();
  for (const TruthGap& gap : gaps) list.push_back({{"from", gap.from}, {"to", gap.to}, {"left_out", gap.left_out}});
  return list;
}

Json to_json(const OpenRoll& roll) {
  return {{"off_line", roll.off_line}, {"angle_deg", kDegrees * roll.angle}};
}

Json to_json(const EvaluationOptions& options) {
  Json json = Json::object();
  for (const OptionInfo& option : describe(options)) json[option.key] = option.value;
  return json;
}

}  // namespace

std::string evaluation_json(const Evaluation& evaluation) {
  Json json{{"ape", to_json(evaluation.ape)}, {"rpe", to_json(evaluation.rpe)}};
  json["rpe"]["pairs"] = evaluation.rpe.translation.errors.size();
  if (evaluation.kitti) json["kitti"] = to_json(*evaluation.kitti);
  json["matches"] = evaluation.matches.truth.size();
  json["truth_poses"] = evaluation.truth_poses;
  json["estimate_poses"] = evaluation.estimate_poses;
  json["start"] = {{"distance", evaluation.start_distance}, {"angle_deg", kDegrees * evaluation.start_angle}};
  json["alignment"] = to_json(evaluation.alignment, evaluation.options.align);
  json["notices"] = notices_of(evaluation);
  json["truth_gaps"] = to_json(evaluation.matches.gaps);
  if (evaluation.open_roll) json["open_roll"] = to_json(*evaluation.open_roll);
  json["options"] = to_json(evaluation.options);
  return json.dump(2) + "\n";
}

}  // namespace tilth
