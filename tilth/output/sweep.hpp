// What the parameters of a pipeline do: the sensitivity studies of Fu et al. 2026 (section 2.3), over sources and
// seeds. docs/comparison.md describes every figure.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tilth/output/comparison.hpp>

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
  JudgingOptions judging;
  std::vector<SweepRun> runs;
};

/// One row a source and setting, over its runs.
FigureTable sweep_table(const Sweep& sweep);

/// Writes sweep.txt, .md, .csv, .json, and for each source and figure of a sweep over two or more parameters a heat map
/// of the first two (means over the rest), heat_SOURCE_FIGURE.svg. Throws Error where one cannot be written.
void write_sweep(const std::filesystem::path& folder, const Sweep& sweep);

}  // namespace tilth
