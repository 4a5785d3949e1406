#include <algorithm>
#include <array>

#include <tilth/io/output_file.hpp>
#include <tilth/report/html_report.hpp>
#include <tilth/study/sweep.hpp>

namespace tilth {
namespace {

const std::vector<FigureColumn>& study_columns() {
  static const std::vector<FigureColumn> columns{{"removed_percent", "removed %", 2},
                                                 {"edges", "edges", 0},
                                                 {"planes", "planes", 0},
                                                 {"outliers_ms", "neighbours+filter ms", 2},
                                                 {"removed_obvious_percent", "obvious removed %", 1},
                                                 {"kept_surface_percent", "surface kept %", 1},
                                                 {"kept_edges_percent", "edges kept %", 1},
                                                 {"filter_accuracy_percent", "accuracy %", 1},
                                                 {"pseudo_reduction_percent", "fewer pseudo %", 1},
                                                 {"pseudo_ratio_percent", "pseudo of edges %", 1}};
  return columns;
}

const std::vector<FigureColumn>& error_columns() {
  static const std::vector<FigureColumn> columns{{"runs", "runs"},          {"failed", "failed"},
                                                 {"ape_rmse_m", "RMSE", 4}, {"ape_mean_m", "mean", 4},
                                                 {"ape_max_m", "max", 4},   {"cpu_ms_mean", "CPU ms", 2}};
  return columns;
}

bool belongs(const SweepRun& run, const MethodSummary& entry) {
  return run.outcome.label.source == entry.source && run.outcome.label.method == entry.method;
}

/// The mean of a figure over the runs of an entry that have it.
Figure mean_figure(const Sweep& sweep, const MethodSummary& entry, const std::string& key) {
  double sum = 0, count = 0;
  for (const SweepRun& run : sweep.runs) {
    const auto found = run.figures.find(key);
    if (!belongs(run, entry) || found == run.figures.end()) continue;
    sum += found->second;
    ++count;
  }
  return count > 0 ? Figure(sum / count) : Figure();
}

std::vector<MethodSummary> summaries_of(const Sweep& sweep) {
  std::vector<RunOutcome> outcomes;
  for (const SweepRun& run : sweep.runs) outcomes.push_back(run.outcome);
  return summarize(outcomes);
}

std::vector<Figure> row_of(const Sweep& sweep, const MethodSummary& entry) {
  const auto run =
      std::find_if(sweep.runs.begin(), sweep.runs.end(), [&](const SweepRun& r) { return belongs(r, entry); });
  std::vector<Figure> row{entry.source};
  for (const std::string& value : run->values) row.emplace_back(value);
  row.insert(row.end(), {double(entry.runs), double(entry.failed)});
  const bool judged = entry.judged > 0;
  for (const double value : {entry.ape.rmse, entry.ape.mean, entry.ape.max, entry.mean.cpu_ms})
    row.push_back(judged ? Figure(value) : Figure());
  for (const FigureColumn& column : study_columns()) row.push_back(mean_figure(sweep, entry, column.key));
  return row;
}

std::vector<std::string> notes_of(const Sweep& sweep) {
  std::vector<std::string> notes{
      "APE of the translation [m] over all poses of all runs of a setting; removed: of the points in range; neighbours+"
      "filter: wall time of that stage. From labelled scans where there are any: obvious outliers removed, surface and "
      "edge structures kept, points judged rightly, pseudo-features (edge features whose point is false) done away "
      "with, "
      "and their share of the edge features left."};
  for (const SweepRun& run : sweep.runs) {
    const RunOutcome& outcome = run.outcome;
    if (outcome.failure.empty()) continue;
    notes.push_back("Failed: " + outcome.label.source + ", seed " + outcome.label.seed + ", " + outcome.label.method +
                    ": " + outcome.failure);
  }
  return notes;
}

}  // namespace

FigureTable sweep_table(const Sweep& sweep) {
  FigureTable table{
      "Sweep of " + sweep.pipeline + ", tilth " + sweep.version, {{"source", "source"}}, {}, notes_of(sweep)};
  for (const std::string& key : sweep.parameters) table.columns.push_back({key, key});
  for (const auto& columns : {error_columns(), study_columns()})
    table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (const MethodSummary& entry : summaries_of(sweep)) table.rows.push_back(row_of(sweep, entry));
  return table;
}

void write_sweep(const std::filesystem::path& folder, const Sweep& sweep) {
  const FigureTable table = sweep_table(sweep);
  const std::array<std::string, 1> names{"sweep"};
  write_text(folder / "sweep.txt", table_text(table));
  write_text(folder / "sweep.md", table_markdown(table));
  write_text(folder / "sweep.csv", table_csv(table));
  write_text(folder / "sweep.json", tables_json(names, {&table, 1}));
  write_report(folder, report_of(sweep));
}

}  // namespace tilth
