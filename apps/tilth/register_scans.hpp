// The loop of a run: scan after scan from the source through the odometry into the record.
#pragma once

#include <cstddef>
#include <functional>

#include "console.hpp"
#include "stage_clock.hpp"
#include <tilth/odometry/odometry.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth::app {

struct LoopOptions {
  std::size_t max_scans = 0;         ///< zero: all
  bool strict = false;               ///< a record that cannot be used ends the run
  std::function<void()> registered;  ///< called after every scan that is registered; empty: nothing is
};

enum class RunEnd { end_of_input, max_scans, interrupted, bad_record, input_broken };

/// In words, for people and summary.json.
std::string to_text(RunEnd end);

class RegistrationLoop {
 public:
  /// All four must outlive the loop; what is computed goes to `record` at once.
  RegistrationLoop(ScanSource& source, Odometry& odometry, RunRecord& record, Console& console);

  RunEnd run(const LoopOptions& options);

 private:
  std::optional<Scan> read();
  bool register_scan(const Scan& scan, double read_ms);
  void keep(const Scan& scan, const OdometryResult& result, ScanRow row);
  void take_skipped();
  void skip(SkippedRecord skipped);

  ScanSource& source_;
  Odometry& odometry_;
  RunRecord& record_;
  Console& console_;
  StageClock clock_;
  std::size_t taken_ = 0;  // of source_.skipped()
  std::size_t read_ = 0;   // scans handed over by the source
  bool broken_ = false;
};

}  // namespace tilth::app
