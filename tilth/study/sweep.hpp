// What the parameters of a pipeline do: the sensitivity studies of Fu et al. 2026 (section 2.3), over sources and
// seeds. docs/comparison.md describes every figure.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tilth/study/comparison.hpp>

namespace tilth {

/// Figures of a run beside its errors, by the keys of the table; what a run does not tell is missing.
using StudyFigures = std::map<std::string, double>;

/// From scans.csv, and score.json (`tilth score-filter`) where there is one, of a run's folder. Throws Error on a file
/// that is there and cannot be understood.
StudyFigures study_figures(const std::filesystem::path& folder);

struct SweepRun {
  std::vector<std::string> values;  ///< of the parameters; as they were in force
  RunOutcome outcome;               ///< its method tells the settings apart
  StudyFigures figures;
};

struct Sweep {
  std::string version, pipeline;
  std::vector<std::string> parameters;  ///< keys
  std::vector<std::string> base;        ///< their values where the sweep changes none
  bool grid = false;                    ///< every combination was run, not each parameter alone
  JudgingOptions judging;
  std::vector<SweepRun> runs;
};

/// One row a source and setting, over its runs.
FigureTable sweep_table(const Sweep& sweep);

/// Every figure over each parameter alone, the others at their base (or, where that was not run, at the first of their
/// values); the tables; of a grid the figures over the first two parameters as heat maps, means over the rest.
Report report_of(const Sweep& sweep);

/// Writes sweep.txt, .md, .csv, .json, and report.html with plots/. Throws Error where one cannot be written.
void write_sweep(const std::filesystem::path& folder, const Sweep& sweep);

}  // namespace tilth
