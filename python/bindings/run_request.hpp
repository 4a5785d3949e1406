// A run as Python asks for it, and what came of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interrupt.hpp"
#include <tilth/core/options.hpp>
#include <tilth/run/run_observer.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/truth_file.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::python {

struct RunRequest {
  std::string source, pipeline;
  std::string out;  ///< folder of the files; empty: none
  SourceOptions input;
  OptionValues values, loop, map;         ///< of the pipeline, of SlamOptions and of MapOptions
  OptionValues output, report;            ///< of OutputOptions and ReportOptions
  std::string beams, truth, calibration;  ///< files; empty: none
  std::string base_from_lidar;            ///< as parse_mount takes it; empty: not known
  std::size_t max_scans = 0;              ///< zero: all
  int threads = 0;                        ///< zero: as many as there are processors
  bool loop_closure = false, learn_beams = false, strict = false;
};

struct RunOutcome {
  RunRecord record;
  bool interrupted = false;
  std::vector<std::string> failures;  ///< what could not be written or judged, one sentence each
};

/// The run that `tilth run` makes of the same request, to the last bit; an interrupt ends it. Throws Error on what is
/// wrong before the first scan, and where there is no scan that can be used.
RunOutcome perform(const RunRequest& request, RunObserver& observer, Interrupt& interrupt);

}  // namespace tilth::python
