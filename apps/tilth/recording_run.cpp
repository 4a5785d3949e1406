#include "recording_run.hpp"

#include "motion_prior_file.hpp"
#include <tilth/core/error.hpp>
#include <tilth/run/ended_run.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/sources/describe_source.hpp>
#include <tilth/view/view_sink.hpp>

namespace tilth::app {
namespace {

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
  const RunArguments& run = arguments_.run;
  if (!arguments_.truth.empty()) truth_ = read_truth(arguments_.truth, arguments_.calibration);
  plan_ = plan_run(run, describe_source(arguments_.input), describe_source({}));
  view_ = open_view(run, observer_);
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
    folder_.emplace(run.out, files_);
    for (const RunOutput& output : plan_.outputs) session_->add(output.open(*folder_ / output.file));
  }
  if (view_) session_->add(std::make_unique<ViewSink>(view_));
  if (run.save_map.empty()) return;
  const std::filesystem::path changes = folder_ ? *folder_ / "map_changes.csv" : std::filesystem::path();
  session_->add(saved_map_sink(saved_map(run, plan_, changes), *slam));
}

RunOutcome RecordingRun::run() {
  RunOutcome outcome{.end = run_session(*session_, arguments_.run), .files = files_};
  RunRecord& record = session_->record();
  if (outcome.end != RunEnd::interrupted) require_scans(record);
  if (truth_) outcome.failures = judge_by(*truth_, record);
  if (plan_.external) notice_prior(*plan_.external, arguments_.run.prior, record, observer_);
  for (std::string& failure : session_->finish()) outcome.failures.push_back(std::move(failure));
  outcome.record = std::move(record);
  return outcome;
}

}  // namespace tilth::app
