#include "recording_run.hpp"

#include "motion_prior_file.hpp"
#include <tilth/calibration/beam_learner.hpp>
#include <tilth/core/error.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/beam_record.hpp>
#include <tilth/run/ended_run.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/sources/describe_source.hpp>
#include <tilth/sources/live_scans.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth::app {
namespace {

constexpr std::size_t kEnoughWindows = 24;  // of a first pass: 120 m and more

SavedMapPlan saved_map(const RunArguments& run, const PlannedRun& plan, std::filesystem::path changes) {
  const auto beams = plan.beams ? std::optional(plan.beams->model) : std::nullopt;
  return {run.save_map, run.map_to_continue, plan.localize, beams, std::move(changes)};
}

std::unique_ptr<ScanSource> source_of(const RecordingArguments& arguments, const PlannedRun& plan) {
  SourceOptions input = arguments.input;
  input.stopped = arguments.run.session.interrupted;
  return corrected_source(open_source(arguments.run.source, input), arguments.run, plan);
}

}  // namespace

RecordingRun::RecordingRun(const RecordingArguments& arguments, RunObserver& observer)
    : arguments_(arguments), observer_(observer) {
  if (!arguments_.truth.empty()) truth_ = read_truth(arguments_.truth, arguments_.calibration);
  begin();
}

void RecordingRun::begin() {
  const RunArguments& run = arguments_.run;
  plan_ = plan_run(run, describe_source(arguments_.input), describe_source({}));
  if (!view_) view_ = open_view(run, observer_);
  learner_ = plan_.pipeline.beams;
  std::unique_ptr<ScanSource> source = begin_world(source_of(arguments_, plan_), run, plan_, observer_);
  const Slam* const slam = plan_.pipeline.slam;
  session_.emplace(std::move(source), std::move(plan_.pipeline), std::move(plan_.record));
  session_->observe(observer_);
  add_sinks(slam);
}

void RecordingRun::add_sinks(const Slam* slam) {
  const RunArguments& run = arguments_.run;
  if (!run.out.empty()) {
    files_ = files_of(plan_.outputs);
    if (!folder_) folder_.emplace(run.out, files_);
    for (const RunOutput& output : plan_.outputs) session_->add(output.open(*folder_ / output.file));
  }
  if (view_) session_->add(std::make_unique<ViewSink>(view_));
  if (run.save_map.empty()) return;
  const std::filesystem::path changes = folder_ ? *folder_ / "map_changes.csv" : std::filesystem::path();
  session_->add(saved_map_sink(saved_map(run, plan_, changes), *slam));
}

/// Pipelines of others stay what was published; a sensor sends nothing twice.
bool RecordingRun::may_begin_anew() const {
  const RunArguments& run = arguments_.run;
  std::error_code unknown;
  const bool again = !is_live(run.source) && !std::filesystem::is_fifo(run.source, unknown);
  return again && !run.keep_beams && !run.learn_beams && session_->record().pipeline == pipelines().front().name;
}

bool RecordingRun::shows_errors(const std::optional<BeamCalibration>& found) const {
  return found && worth_a_second_pass(*found, plan_.beams ? plan_.beams->model : BeamModel{});
}

/// To its end, or to where it is known well enough what the beams err.
RunEnd RecordingRun::first_pass() {
  RunArguments run = arguments_.run;
  run.session.enough = [this] {
    const std::optional<BeamCalibration>& found = learner_->found();
    return found && found->windows >= kEnoughWindows && shows_errors(found);
  };
  return run_session(*session_, run);
}

void RecordingRun::begin_anew(std::optional<BeamEstimate> found) {
  const double spent = session_->record().wall_seconds;
  arguments_.run.found_beams = std::move(found);
  session_.reset();
  begin();
  session_->record().wall_seconds = spent;
}

RunEnd RecordingRun::run_passes() {
  const RunEnd end = first_pass();
  const std::optional<BeamCalibration> found = session_->record().beams;
  if (end == RunEnd::interrupted || end == RunEnd::bad_record || !shows_errors(found)) return end;
  observer_.note("beams: " + beams_sentence(*found) + "; begun anew without them (--keep-beams: not)");
  begin_anew(found->beams);
  const RunEnd second = run_session(*session_, arguments_.run);
  const std::optional<BeamCalibration>& left = session_->record().beams;
  const bool whole = second != RunEnd::input_broken || end == RunEnd::input_broken;
  if (second == RunEnd::interrupted || (whole && left && left->before.thickness < found->before.thickness))
    return second;
  const std::string kept = "beams: without those errors the run is no better; begun anew with the beams as they are";
  observer_.warn(kept);
  begin_anew(std::nullopt);
  const RunEnd third = run_session(*session_, arguments_.run);
  session_->record().notices.push_back(kept);
  return third;
}

RunOutcome RecordingRun::run() {
  RunOutcome outcome{.end = may_begin_anew() ? run_passes() : run_session(*session_, arguments_.run), .files = files_};
  RunRecord& record = session_->record();
  if (outcome.end != RunEnd::interrupted) require_scans(record);
  if (truth_) outcome.failures = judge_by(*truth_, record);
  if (plan_.external) notice_prior(*plan_.external, arguments_.run.prior, record, observer_);
  for (std::string& failure : session_->finish()) outcome.failures.push_back(std::move(failure));
  outcome.record = std::move(record);
  return outcome;
}

}  // namespace tilth::app
