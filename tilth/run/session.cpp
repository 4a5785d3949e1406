#include <utility>

#include <tilth/calibration/beam_learner.hpp>
#include <tilth/core/error.hpp>
#include <tilth/run/machine.hpp>
#include <tilth/run/scan_row.hpp>
#include <tilth/run/session.hpp>
#include <tilth/run/skipped_scans.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth {
namespace {

constexpr std::size_t kSurveyed = 16;  ///< of so many points one is counted, for what `tilth info` warns of

}  // namespace

std::string to_text(RunEnd end) {
  switch (end) {
    case RunEnd::end_of_input: return "end of input";
    case RunEnd::max_scans: return "as many scans as asked for";
    case RunEnd::interrupted: return "interrupted";
    case RunEnd::bad_record: return "a record that cannot be used (--strict)";
    case RunEnd::input_broken: return "the input breaks off";
  }
  return {};
}

Session::Session(std::unique_ptr<ScanSource> source, Pipeline pipeline, RunRecord record)
    : source_(std::move(source)), pipeline_(std::move(pipeline)), record_(std::move(record)), survey_(kSurveyed) {
  pipeline_.odometry->listen([this](std::string_view stage) { clock_.begin(stage); });
}

RunEnd Session::run(const SessionOptions& options) {
  const Stopwatch stopwatch;
  record_.ended = "it goes on";  // as what is saved meanwhile says
  const RunEnd end = register_scans(options);
  take_notices();
  if (pipeline_.beams != nullptr) record_.beams = pipeline_.beams->found();
  record_.map.settle();
  if (pipeline_.slam != nullptr) close_loops(*pipeline_.slam, record_);
  record_.ended = to_text(end);
  record_.wall_seconds += stopwatch.seconds();
  record_.peak_megabytes = peak_megabytes();
  return end;
}

std::vector<std::string> Session::finish() {
  return finish_all(sinks_, record_);
}

RunEnd Session::register_scans(const SessionOptions& options) {
  while (options.max_scans == 0 || read_ < options.max_scans) {
    if (options.interrupted && options.interrupted()) return RunEnd::interrupted;
    if (options.enough && options.enough()) return RunEnd::max_scans;
    const Stopwatch reading;
    const std::optional<Scan> scan = read();
    if (options.strict && !record_.skipped.empty()) return RunEnd::bad_record;
    if (!scan) return broken_ ? RunEnd::input_broken : RunEnd::end_of_input;
    if (read_++ == 0) take_decisions();
    survey_.add(*scan);
    const std::optional<OdometryResult> result = register_scan(*scan, reading.milliseconds());
    if (!result && options.strict) return RunEnd::bad_record;
    if (result) {
      for (const std::unique_ptr<Sink>& sink : sinks_) sink->take(*scan, *result, record_);
    }
    observer_->progress(read_, source_->size());
  }
  return RunEnd::max_scans;
}

void Session::take_decisions() {
  record_.decisions = source_->decisions();
  for (const std::string& decision : record_.decisions) observer_->note(decision);
}

/// What the source noticed, and what may go wrong with such a recording.
void Session::take_notices() {
  record_.notices = source_->notices();
  for (const std::string& notice : record_.notices) observer_->note(notice);
  for (std::string& warning : survey_warnings(survey_)) {
    observer_->warn(warning);
    record_.notices.push_back(std::move(warning));
  }
}

std::optional<Scan> Session::read() {
  try {
    std::optional<Scan> scan = source_->next();
    take_skipped();
    return scan;
  } catch (const std::exception& e) {
    take_skipped();
    skip({read_ + taken_, "input", e.what()});
    broken_ = true;
    return std::nullopt;
  }
}

std::optional<OdometryResult> Session::register_scan(const Scan& scan, double read_ms) {
  try {
    const double cpu_before = thread_cpu_milliseconds();
    clock_.start();
    OdometryResult result = pipeline_.odometry->register_scan(scan);
    ScanRow row = row_of(scan, result);
    row.register_ms = clock_.stop();
    row.register_cpu_ms = thread_cpu_milliseconds() - cpu_before;
    row.stage_ms = clock_.milliseconds();
    row.read_ms = read_ms;
    keep(scan, result, std::move(row));
    tell_track(result);
    return result;
  } catch (const Error& e) {
    skip({read_ - 1 + taken_, "scan " + std::to_string(read_ - 1 + taken_), e.what()});
    return std::nullopt;
  }
}

void Session::keep(const Scan& scan, const OdometryResult& result, ScanRow row) {
  const Stopwatch mapping;
  record_.map.add(result, scan.stamp);
  row.map_ms = mapping.milliseconds();
  record_.trajectory.push_back({result.stamp, result.T_world_lidar});
  if (pipeline_.slam != nullptr) record_.T_map_odom = pipeline_.slam->T_map_odom();
  record_.scans.stages = clock_.stages();
  record_.scans.rows.push_back(std::move(row));
}

void Session::tell_track(const OdometryResult& result) {
  const bool was_lost = track_ == TrackState::lost, is_lost = result.track.state == TrackState::lost;
  track_ = result.track.state;
  const std::string when = "at " + std::to_string(result.stamp) + " s";
  const std::string reason(names_of(result.track.reason)[std::size_t(result.track.reason)]);
  if (is_lost && !was_lost)
    observer_->warn("the track is lost " + when + ": " + reason +
                    "; from here on poses are right among themselves at best");
  if (was_lost && !is_lost) observer_->warn("the track is found again " + when);
  if (track_ == TrackState::recovered && !was_lost) observer_->warn("the track is found again " + when + ": " + reason);
}

void Session::take_skipped() {
  for (; taken_ < source_->skipped().size(); ++taken_) skip(source_->skipped()[taken_]);
}

void Session::skip(SkippedScan skipped) {
  keep_skipped(std::move(skipped), *observer_, record_);
}

}  // namespace tilth
