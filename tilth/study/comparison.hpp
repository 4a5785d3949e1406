// Pipelines held against each other on the same scans: the tables of Fu et al. 2026 (section 3) over several seeds.
// docs/comparison.md describes every figure.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <tilth/report/report.hpp>
#include <tilth/study/figure_table.hpp>
#include <tilth/study/run_outcome.hpp>

namespace tilth {

struct Comparison {
  std::string version;
  std::string base;  ///< method that the others are compared with
  JudgingOptions judging;
  std::vector<RunOutcome> runs;
  std::vector<std::string> skipped;       ///< what could not be compared, and why; one sentence each
  std::vector<std::string> remarks = {};  ///< on the methods
};

/// What one method reached on one source, over all its runs. Failed runs count wherever they have a figure.
struct MethodSummary {
  std::string source, method;
  std::size_t runs = 0, failed = 0, judged = 0;  ///< judged: runs that have errors at all
  Metric ape;                                    ///< [m] over all poses of all judged runs together
  double worst_rmse = 0.0;                       ///< [m] of the worst judged run
  double worst_drift = 0.0;                      ///< [%]
  RunOutcome mean;                               ///< its numbers are means over the judged runs
  double mean_nees = 0.0;                        ///< over the runs that have covariances
  std::size_t with_nees = 0;                     ///< how many those are
};

/// One for each source and method, in the order of their first run.
std::vector<MethodSummary> summarize(std::span<const RunOutcome> runs);

/// [%] by which `mean` is less than `base_mean`; negative where it is more.
double improvement(double mean, double base_mean);

FigureTable summary_table(const Comparison& comparison);  ///< one row a source and method
FigureTable runs_table(const Comparison& comparison);     ///< one row a run

/// A section a source: its table, the errors as boxes, CPU times as bars.
Report report_of(const Comparison& comparison);

/// Writes comparison.txt, .md, .csv (the summary), runs.csv, comparison.json (both)
/// and report.html with plots/. Throws Error where one cannot
/// be written.
void write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace tilth
