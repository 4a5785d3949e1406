// A run: scan after scan from a source through a pipeline into a record, and what comes of it into sinks.
//
//   Session session(open_source("recordings/street", {}), {make_odometry("tilth", {})});
//   session.add(tum_sink("trajectory.tum"));
//   session.run();
//   for (const std::string& failure : session.finish()) ...
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tilth/run/pipeline.hpp>
#include <tilth/run/run_observer.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/sink.hpp>
#include <tilth/run/stage_clock.hpp>
#include <tilth/sources/scan_source.hpp>
#include <tilth/sources/scan_survey.hpp>

namespace tilth {

struct SessionOptions {
  std::size_t max_scans = 0;               ///< zero: all
  bool strict = false;                     ///< a record that cannot be used ends the run
  std::function<bool()> interrupted = {};  ///< asked before every scan: true ends the run; empty: never
  std::function<bool()> enough = {};       ///< asked before every scan: true ends it as max_scans does; empty: never
};

enum class RunEnd { end_of_input, max_scans, interrupted, bad_record, input_broken };

/// In words, for people and summary.json.
std::string to_text(RunEnd end);

class Session {
 public:
  /// `record` says what is run (new_record), and goes on with an earlier run where it has poses (continue_run).
  Session(std::unique_ptr<ScanSource> source, Pipeline pipeline, RunRecord record = {});
  Session(const Session&) = delete;  // the odometry reports its stages to this very object
  Session& operator=(const Session&) = delete;

  void add(std::unique_ptr<Sink> sink) { sinks_.push_back(std::move(sink)); }
  void observe(RunObserver& observer) { observer_ = &observer; }  ///< which must outlive the session

  /// Registers what the source has, closes the loops, and says how it ended. Throws Error where a sink refuses a scan.
  RunEnd run(const SessionOptions& options = {});

  /// Finishes every sink; one that fails does not keep the others from it. What went wrong, one sentence a sink.
  [[nodiscard]] std::vector<std::string> finish();

  const RunRecord& record() const { return record_; }
  RunRecord& record() { return record_; }  ///< between run() and finish(), for what only the caller knows

 private:
  RunEnd register_scans(const SessionOptions& options);
  std::optional<Scan> read();
  std::optional<OdometryResult> register_scan(const Scan& scan, double read_ms);
  void keep(const Scan& scan, const OdometryResult& result, ScanRow row);
  void tell_track(const OdometryResult& result);
  void take_decisions();
  void take_notices();
  void take_skipped();
  void skip(SkippedScan skipped);

  std::unique_ptr<ScanSource> source_;
  Pipeline pipeline_;
  RunRecord record_;
  std::vector<std::unique_ptr<Sink>> sinks_;
  RunObserver deaf_;
  RunObserver* observer_ = &deaf_;
  StageClock clock_;
  ScanSurvey survey_;
  std::size_t taken_ = 0;  // of source_->skipped()
  std::size_t read_ = 0;   // scans handed over by the source
  bool broken_ = false;
  TrackState track_ = TrackState::tracking;  // of the last scan
};

}  // namespace tilth
