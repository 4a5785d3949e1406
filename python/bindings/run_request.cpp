#include "run_request.hpp"

#include <memory>

#include "locked_folder.hpp"
#include "threads.hpp"
#include <tilth/io/beam_file.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/beam_pipeline.hpp>
#include <tilth/run/ended_run.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/run/session.hpp>
#include <tilth/sources/beam_corrected_source.hpp>
#include <tilth/sources/describe_source.hpp>

namespace tilth::python {
namespace {

RunRecord record_of(const RunRequest& request) {
  RunRecord record = new_record(request.source, request.pipeline, request.values);
  add_options(describe_source(request.input), describe_source({}), record);
  add_options(describe_beams(request.beams, request.learn_beams), describe_beams({}, false), record);
  add_options(describe_prior({}), describe_prior({}), record);
  add_options(describe_mount(request.base_from_lidar, false), describe_mount({}, false), record);
  if (!request.base_from_lidar.empty()) record.T_base_lidar = parse_mount(request.base_from_lidar);
  if (request.loop_closure) add_options(describe(with<SlamOptions>(request.loop)), describe(SlamOptions{}), record);
  record.map = MapBuilder(with<MapOptions>(request.map));
  return record;
}

Pipeline pipeline_of(const RunRequest& request) {
  const SlamOptions loop = with<SlamOptions>(request.loop);  // wrong ones are refused also where none is used
  std::optional<BeamEstimate> known;
  if (!request.beams.empty()) known = read_beams(request.beams);
  Pipeline pipeline = with_beams(make_odometry(request.pipeline, request.values),
                                 request.learn_beams ? BeamLearning::correct : BeamLearning::watch, std::move(known));
  if (!request.base_from_lidar.empty())
    pipeline.odometry =
        std::make_unique<ContinuedOdometry>(std::move(pipeline.odometry), parse_mount(request.base_from_lidar));
  return request.loop_closure ? with_loop_closure(std::move(pipeline), loop) : std::move(pipeline);
}

std::unique_ptr<ScanSource> source_of(const RunRequest& request, Interrupt& interrupt) {
  SourceOptions input = request.input;
  input.stopped = [&interrupt] { return interrupt.came(); };
  std::unique_ptr<ScanSource> source = open_source(request.source, input);
  if (request.beams.empty()) return source;
  return beam_corrected_source(std::move(source), read_beams(request.beams).model, request.beams);
}

std::vector<RunOutput> outputs_of(const RunRequest& request) {
  const auto output = with<OutputOptions>(request.output);
  const auto report = with<ReportOptions>(request.report);
  if (request.out.empty()) return {};
  return run_outputs(output, report, request.loop_closure, with<MapOptions>(request.map).keep_moving);
}

std::optional<app::LockedFolder> folder_of(const RunRequest& request, const std::vector<RunOutput>& outputs) {
  if (request.out.empty()) return std::nullopt;
  std::vector<std::string> files;
  for (const RunOutput& output : outputs) files.push_back(output.file);
  return std::optional<app::LockedFolder>(std::in_place, request.out, files);
}

}  // namespace

RunOutcome perform(const RunRequest& request, RunObserver& observer, Interrupt& interrupt) {
  std::optional<TruthFile> truth;
  if (!request.truth.empty()) truth = read_truth(request.truth, request.calibration);
  const std::vector<RunOutput> outputs = outputs_of(request);
  Session session(source_of(request, interrupt), pipeline_of(request), record_of(request));
  session.observe(observer);
  const std::optional<app::LockedFolder> folder = folder_of(request, outputs);
  for (const RunOutput& output : outputs) session.add(output.open(*folder / output.file));
  const SessionOptions options{request.max_scans, request.strict, [&] { return interrupt.came(); }};
  const RunEnd end = app::with_threads(request.threads, [&] { return session.run(options); });
  RunOutcome outcome{{}, end == RunEnd::interrupted, {}};
  if (!outcome.interrupted) require_scans(session.record());
  if (truth) outcome.failures = judge_by(*truth, session.record());
  for (std::string& failure : session.finish()) outcome.failures.push_back(std::move(failure));
  outcome.record = std::move(session.record());
  return outcome;
}

}  // namespace tilth::python
