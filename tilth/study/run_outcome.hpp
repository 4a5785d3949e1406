// What became of one run of a comparison: read from the folder that it was written to, judged by its truth.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tilth/evaluation/consistency.hpp>
#include <tilth/evaluation/evaluate.hpp>

namespace tilth {

struct RunLabel {
  std::string source, seed, method;  ///< seed: empty where there is none
};

struct RunOutcome {
  RunLabel label;
  std::string folder;
  std::string failure;              ///< empty, or why the run counts as failed
  std::size_t scans = 0, lost = 0;  ///< poses; scans without one
  double path = 0.0;                ///< [m] of the truth
  std::vector<double> ape;          ///< [m] of the translation, a pose; empty where nothing could be judged
  double ape_rotation = 0.0;        ///< [deg] RMSE
  double rpe = 0.0;                 ///< [m] RMSE of the translation
  double rpe_rotation = 0.0;        ///< [deg] RMSE
  double end_drift = 0.0;           ///< [%] of the path: where the run ends, first poses made equal
  double cpu_ms = 0.0;              ///< [ms] CPU time a scan, mean
  double cpu_ms_p99 = 0.0;          ///< [ms]
  double peak_megabytes = 0.0;      ///< [MB] resident
  std::optional<Consistency> consistency;
};

struct RunPlace {
  std::filesystem::path folder, truth;
  std::size_t expected = 0;  ///< scans that there are; zero: as many as the run says
};

struct JudgingOptions {
  EvaluationOptions evaluation;
  double max_ape = 0.0;  ///< [m] RMSE from which on a run counts as failed
};

/// How runs are judged where nothing else is asked for: rigidly aligned, truth interpolated, RPE over ten scans.
JudgingOptions judging_defaults();

/// The outcome of the run in `place`. `failure` is what is known to have gone wrong already, or empty. Whatever cannot
/// be read or judged makes the run a failed one; nothing is thrown.
RunOutcome judge_run(const RunPlace& place, const RunLabel& label, const JudgingOptions& options, std::string failure);

}  // namespace tilth
