#include <array>
#include <cstdio>
#include <numbers>

#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/pose_file.hpp>
#include <tilth/run/scan_columns.hpp>
#include <tilth/run/truth_file.hpp>
#include <tilth/study/run_outcome.hpp>

namespace tilth {
namespace {

using Json = nlohmann::json;

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian

/// [%] of the path between the last poses, the first ones made equal.
double end_drift_of(const MatchedPoses& matches, double path) {
  const Pose truth = relative_pose(matches.truth.front().T_world_lidar, matches.truth.back().T_world_lidar);
  const Pose estimate = relative_pose(matches.estimate.front().T_world_lidar, matches.estimate.back().T_world_lidar);
  return path > 0 ? 100 * (truth.translation() - estimate.translation()).norm() / path : 0;
}

/// The variances in scans.csv, a row a pose; none where they are missing.
std::vector<Vector6d> variances_of(const std::filesystem::path& scans_csv) {
  if (!std::filesystem::exists(scans_csv)) return {};
  const ScanColumns columns = read_scan_columns(scans_csv);
  constexpr std::array<const char*, 6> kNames{"var_rx", "var_ry", "var_rz", "var_tx", "var_ty", "var_tz"};
  std::vector<Vector6d> variances;
  for (std::size_t axis = 0; axis < kNames.size(); ++axis) {
    const auto column = columns.find(kNames[axis]);
    if (column == columns.end()) return {};
    variances.resize(column->second.size());
    for (std::size_t i = 0; i < variances.size(); ++i) variances[i][Eigen::Index(axis)] = column->second[i];
  }
  return variances;
}

/// Of the matches, whose estimates are poses of `estimate`; none where not each of those has its variances.
std::optional<Consistency> consistency_of(const std::vector<Vector6d>& variances, const Trajectory& estimate,
                                          const MatchedPoses& matches) {
  if (variances.size() != estimate.size()) return std::nullopt;
  std::vector<Vector6d> matched;
  std::size_t row = 0;
  for (const StampedPose& pose : matches.estimate) {
    while (row < estimate.size() && estimate[row].stamp < pose.stamp) ++row;
    matched.push_back(variances.at(row));
  }
  const Consistency found = consistency(matches, matched);
  return found.poses == 0 ? std::nullopt : std::optional(found);
}

void take_summary(const std::filesystem::path& path, RunOutcome& outcome) {
  const Json summary = Json::parse(as_text(read_file(path)));
  const Json& cpu = summary.at("milliseconds").at("register_cpu");
  outcome.cpu_ms = cpu.at("mean");
  outcome.cpu_ms_p99 = cpu.at("p99");
  outcome.peak_megabytes = summary.at("peak_megabytes");
  outcome.lost = summary.at("counts").at("skipped");
  const std::string ended = summary.at("ended");
  const bool whole = ended == "end of input" || ended == "as many scans as asked for";
  if (!whole && outcome.failure.empty()) outcome.failure = "ended early: " + ended;
}

void take_errors(const Evaluation& evaluation, RunOutcome& outcome) {
  outcome.path = path_length(evaluation.matches.truth);
  outcome.ape = evaluation.ape.translation.errors;
  outcome.ape_rotation = kDegrees * evaluation.ape.rotation.rmse;
  outcome.rpe = evaluation.rpe.translation.rmse;
  outcome.rpe_rotation = kDegrees * evaluation.rpe.rotation.rmse;
  outcome.end_drift = end_drift_of(evaluation.matches, outcome.path);
}

std::string verdict(const RunOutcome& outcome, double rmse, double max_ape) {
  if (outcome.lost > 0) return std::to_string(outcome.lost) + " scans lost";
  if (rmse <= max_ape) return "";
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "APE RMSE %.3f m, bound %g m", rmse, max_ape);
  return text.data();
}

}  // namespace

JudgingOptions judging_defaults() {
  JudgingOptions options;
  options.evaluation.align = Alignment::se3;
  options.evaluation.association.interpolate = true;  // truth and poses seldom share their stamps
  options.evaluation.rpe.pairs.delta = 10;            // frames: about a second, also where nothing moves
  options.evaluation.rpe.pairs.all_pairs = true;
  options.max_ape = 2.0;
  return options;
}

RunOutcome judge_run(const RunPlace& place, const RunLabel& label, const JudgingOptions& options, std::string failure) {
  RunOutcome outcome;
  outcome.label = label;
  outcome.folder = place.folder.string();
  outcome.failure = std::move(failure);
  try {
    take_summary(place.folder / "summary.json", outcome);
    const PoseFile estimate = read_pose_file(place.folder / "trajectory.tum");
    outcome.scans = estimate.trajectory.size();
    if (place.expected > outcome.scans) outcome.lost = place.expected - outcome.scans;
    const TruthFile truth = read_truth(place.truth);
    EvaluationOptions evaluating = options.evaluation;
    evaluating.association.interpolate = evaluating.association.interpolate && truth.poses.has_stamps;
    const Evaluation evaluation = judge(truth, estimate, evaluating);
    take_errors(evaluation, outcome);
    outcome.consistency =
        consistency_of(variances_of(place.folder / "scans.csv"), estimate.trajectory, evaluation.matches);
    if (outcome.failure.empty()) outcome.failure = verdict(outcome, evaluation.ape.translation.rmse, options.max_ape);
  } catch (const std::exception& e) {
    if (outcome.failure.empty()) outcome.failure = e.what();
  }
  return outcome;
}

}  // namespace tilth
