// A recording becomes a record and files: what `tilth run` and Python's tilth.run do.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "locked_folder.hpp"
#include "run_plan.hpp"
#include <tilth/run/truth_file.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {

/// `run.session.interrupted` also ends the wait for a sensor; without `run.out` no file is written.
struct RecordingArguments {
  RunArguments run;
  std::string truth, calibration;  ///< as read_truth takes them; empty: none
  SourceOptions input;
};

struct RunOutcome {
  RunRecord record = {};
  RunEnd end = RunEnd::end_of_input;
  std::vector<std::string> files = {};     ///< their names in the folder
  std::vector<std::string> failures = {};  ///< what could not be written or judged, one sentence each
};

class RecordingRun {
 public:
  /// Reads, opens and locks all that is asked for; `observer` hears what happens and outlives this. Throws Error on
  /// what is wrong before the first scan.
  RecordingRun(const RecordingArguments& arguments, RunObserver& observer);

  /// Once. Where the drive shows errors of the beams it begins anew without them, once (docs/beams.md). Throws Error
  /// where there is no scan that can be used.
  RunOutcome run();

 private:
  void begin();
  void add_sinks(const Slam* slam);
  bool may_begin_anew() const;
  bool shows_errors(const std::optional<BeamCalibration>& found) const;
  RunEnd first_pass();
  RunEnd run_passes();
  void begin_anew(std::optional<BeamEstimate> found);

  RecordingArguments arguments_;
  RunObserver& observer_;
  std::optional<TruthFile> truth_;
  PlannedRun plan_;
  std::shared_ptr<const BeamLearner> learner_;
  std::vector<std::string> files_;
  std::shared_ptr<ViewServer> view_;
  std::optional<Session> session_;
  std::optional<LockedFolder> folder_;
};

}  // namespace tilth::app
