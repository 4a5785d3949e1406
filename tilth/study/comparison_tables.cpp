#include <algorithm>
#include <array>
#include <cstdio>

#include <tilth/io/output_file.hpp>
#include <tilth/report/html_report.hpp>
#include <tilth/study/comparison.hpp>

namespace tilth {
namespace {

using Row = std::vector<Figure>;

const std::vector<FigureColumn>& summary_columns() {
  static const std::vector<FigureColumn> columns{{"source", "source"},
                                                 {"method", "method"},
                                                 {"runs", "runs"},
                                                 {"failed", "failed"},
                                                 {"ape_max_m", "max", 4},
                                                 {"ape_mean_m", "mean", 4},
                                                 {"ape_median_m", "median", 4},
                                                 {"ape_min_m", "min", 4},
                                                 {"ape_rmse_m", "RMSE", 4},
                                                 {"ape_std_m", "std", 4},
                                                 {"ape_worst_rmse_m", "worst RMSE", 4},
                                                 {"mean_below_base_percent", "mean below base %", 1},
                                                 {"ape_rotation_rmse_deg", "rot. deg", 3},
                                                 {"rpe_rmse_m", "RPE m", 4},
                                                 {"rpe_rotation_rmse_deg", "RPE deg", 3},
                                                 {"end_drift_percent", "end drift %", 3},
                                                 {"end_drift_worst_percent", "worst %", 3},
                                                 {"cpu_ms_mean", "CPU ms", 1},
                                                 {"cpu_ms_p99", "p99", 1},
                                                 {"peak_megabytes", "MB", 0},
                                                 {"nees_mean", "NEES", 1},
                                                 {"nees_consistent", "consistent"}};
  return columns;
}

const MethodSummary* base_of(const std::vector<MethodSummary>& all, const std::string& source,
                             const std::string& base) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const MethodSummary& entry) {
    return entry.source == source && entry.method == base && entry.judged > 0;
  });
  return found == all.end() ? nullptr : &*found;
}

/// NEES and whether the mean over the runs lies where it should, a run counted as one sample: its errors hang together.
void add_nees(const MethodSummary& entry, Row& row) {
  if (entry.with_nees == 0) return;
  const std::array<double, 2> bounds = mean_nees_bounds(entry.with_nees);
  const bool consistent = entry.mean_nees >= bounds[0] && entry.mean_nees <= bounds[1];
  row.insert(row.end(), {entry.mean_nees, std::string(consistent ? "yes" : "no")});
}

Row summary_row(const MethodSummary& entry, const MethodSummary* base) {
  Row row{entry.source, entry.method, double(entry.runs), double(entry.failed)};
  if (entry.judged > 0) {
    const Metric& ape = entry.ape;
    const RunOutcome& mean = entry.mean;
    row.insert(row.end(), {ape.max, ape.mean, ape.median, ape.min, ape.rmse, ape.std, entry.worst_rmse});
    row.push_back(base ? Figure(improvement(ape.mean, base->ape.mean)) : Figure());
    row.insert(row.end(), {mean.ape_rotation, mean.rpe, mean.rpe_rotation, mean.end_drift, entry.worst_drift,
                           mean.cpu_ms, mean.cpu_ms_p99, mean.peak_megabytes});
    add_nees(entry, row);
  }
  row.resize(summary_columns().size());
  return row;
}

const std::vector<FigureColumn>& run_columns() {
  static const std::vector<FigureColumn> columns{{"source", "source"},
                                                 {"seed", "seed"},
                                                 {"method", "method"},
                                                 {"failure", "failure"},
                                                 {"scans", "scans"},
                                                 {"lost", "lost"},
                                                 {"path_m", "path m", 2},
                                                 {"ape_max_m", "max", 4},
                                                 {"ape_mean_m", "mean", 4},
                                                 {"ape_median_m", "median", 4},
                                                 {"ape_min_m", "min", 4},
                                                 {"ape_rmse_m", "RMSE", 4},
                                                 {"ape_std_m", "std", 4},
                                                 {"ape_rotation_rmse_deg", "rot. deg", 3},
                                                 {"rpe_rmse_m", "RPE m", 4},
                                                 {"rpe_rotation_rmse_deg", "RPE deg", 3},
                                                 {"end_drift_percent", "end drift %", 3},
                                                 {"cpu_ms_mean", "CPU ms", 1},
                                                 {"cpu_ms_p99", "p99", 1},
                                                 {"peak_megabytes", "MB", 0},
                                                 {"nees_mean", "NEES", 1},
                                                 {"nees_inside_percent", "inside 95 % bounds", 1},
                                                 {"folder", "folder"}};
  return columns;
}

Row run_row(const RunOutcome& run) {
  Row row{run.label.source, run.label.seed, run.label.method, run.failure, double(run.scans), double(run.lost)};
  if (!run.ape.empty()) {
    const Metric ape = metric_of(run.ape);
    row.insert(row.end(), {run.path, ape.max, ape.mean, ape.median, ape.min, ape.rmse, ape.std});
    row.insert(row.end(), {run.ape_rotation, run.rpe, run.rpe_rotation, run.end_drift, run.cpu_ms, run.cpu_ms_p99,
                           run.peak_megabytes});
    if (run.consistency) row.insert(row.end(), {run.consistency->mean_nees, 100 * run.consistency->inside});
  }
  row.resize(run_columns().size());
  row.back() = run.folder;
  return row;
}

std::string named(const RunLabel& label) {
  return label.source + (label.seed.empty() ? "" : ", seed " + label.seed) + ", " + label.method;
}

std::vector<std::string> notes_of(const Comparison& comparison) {
  std::array<char, 64> bound{};
  std::snprintf(bound.data(), bound.size(), "%g", comparison.judging.max_ape);
  std::vector<std::string> notes{
      "APE of the translation [m] over all poses of all runs together; rot.: of the rotation; RPE over ten scans "
      "unless asked otherwise; drift: "
      "of the end, first poses made equal, in % of the path; CPU ms: a scan on one core, reading not counted.",
      "A run fails that ends with an error, loses scans or has an APE RMSE above " + std::string(bound.data()) +
          " m; failed runs count in every figure that they have.",
      "Base: " + comparison.base + "."};
  for (const RunOutcome& run : comparison.runs) {
    if (run.failure.empty()) continue;
    notes.push_back("Failed: " + named(run.label) + ": " + run.failure + (run.ape.empty() ? " (no figures)." : "."));
  }
  notes.insert(notes.end(), comparison.remarks.begin(), comparison.remarks.end());
  for (const std::string& skipped : comparison.skipped) notes.push_back("Skipped: " + skipped);
  return notes;
}

}  // namespace

FigureTable summary_table(const Comparison& comparison) {
  FigureTable table{"Comparison, tilth " + comparison.version, summary_columns(), {}, notes_of(comparison)};
  const std::vector<MethodSummary> all = summarize(comparison.runs);
  for (const MethodSummary& entry : all)
    table.rows.push_back(summary_row(entry, base_of(all, entry.source, comparison.base)));
  return table;
}

FigureTable runs_table(const Comparison& comparison) {
  FigureTable table{"Every run", run_columns(), {}, {}};
  for (const RunOutcome& run : comparison.runs) table.rows.push_back(run_row(run));
  return table;
}

void write_comparison(const std::filesystem::path& folder, const Comparison& comparison) {
  const std::array<FigureTable, 2> tables{summary_table(comparison), runs_table(comparison)};
  const std::array<std::string, 2> names{"summary", "runs"};
  write_text(folder / "comparison.txt", table_text(tables[0]));
  write_text(folder / "comparison.md", table_markdown(tables[0]));
  write_text(folder / "comparison.csv", table_csv(tables[0]));
  write_text(folder / "runs.csv", table_csv(tables[1]));
  write_text(folder / "comparison.json", tables_json(names, tables));
  write_report(folder, report_of(comparison));
}

}  // namespace tilth
