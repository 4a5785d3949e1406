#include <array>
#include <cstdio>

#include <tilth/report/report.hpp>
#include <tilth/study/comparison.hpp>

namespace tilth {
namespace {

std::string rounded(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

Table table_of(const std::vector<MethodSummary>& entries) {
  Table table{"Absolute pose error of the translation [m] over all poses of all runs",
              {"method", "failed", "max", "mean", "median", "min", "RMSE", "std", "worst RMSE", "CPU ms"},
              {},
              true};
  for (const MethodSummary& entry : entries) {
    table.rows.push_back({entry.method, std::to_string(entry.failed) + " of " + std::to_string(entry.runs)});
    if (entry.judged == 0) table.rows.back().resize(table.columns.size(), "-");
    if (entry.judged == 0) continue;
    const Metric& ape = entry.ape;
    for (const double value : {ape.max, ape.mean, ape.median, ape.min, ape.rmse, ape.std, entry.worst_rmse})
      table.rows.back().push_back(rounded(value, 4));
    table.rows.back().push_back(rounded(entry.mean.cpu_ms, 1));
  }
  return table;
}

Plot errors_of(const std::vector<MethodSummary>& entries, const std::string& number) {
  Plot plot;
  plot.id = "ape_" + number;
  plot.title = "Errors of all poses";
  plot.kind = PlotKind::boxes;
  plot.y = {"APE", "m"};
  for (const MethodSummary& entry : entries) {
    if (entry.judged == 0) continue;
    plot.curves.push_back({entry.method, {}, {entry.ape.errors.begin(), entry.ape.errors.end()}, {}});
  }
  return plot;
}

/// A group of bars for each method: `figures` of it, one for each of the `curves`.
template <class Figures>
Plot bars_of(const std::vector<MethodSummary>& entries, Plot plot, const Figures& figures) {
  plot.kind = PlotKind::bars;
  for (const MethodSummary& entry : entries) {
    if (entry.judged == 0) continue;
    plot.categories.push_back(entry.method);
    const auto values = figures(entry);
    for (std::size_t i = 0; i < values.size(); ++i) plot.curves[i].y.push_back(float(values[i]));
  }
  return plot;
}

Plot statistics_of(const std::vector<MethodSummary>& entries, const std::string& number) {
  Plot plot;
  plot.id = "ape_bars_" + number;
  plot.title = "Statistics of the errors";
  plot.y = {"APE", "m"};
  plot.curves = {{"median", {}, {}, {}}, {"mean", {}, {}, {}}, {"RMSE", {}, {}, {}}, {"max", {}, {}, {}}};
  return bars_of(entries, plot, [](const MethodSummary& entry) {
    return std::array{entry.ape.median, entry.ape.mean, entry.ape.rmse, entry.ape.max};
  });
}

Plot times_of(const std::vector<MethodSummary>& entries, const std::string& number) {
  Plot plot;
  plot.id = "cpu_" + number;
  plot.title = "CPU time a scan";
  plot.y = {"CPU time", "ms"};
  plot.curves = {{"mean", {}, {}, {}}, {"99th percentile", {}, {}, {}}};
  return bars_of(entries, plot, [](const MethodSummary& entry) {
    return std::array{entry.mean.cpu_ms, entry.mean.cpu_ms_p99};
  });
}

Section section_of(const std::vector<MethodSummary>& entries, const std::string& number) {
  Section section{"source_" + number, entries.front().source, "", {table_of(entries)}, {}};
  const Plot errors = errors_of(entries, number);
  if (!errors.curves.empty()) section.plots = {errors, statistics_of(entries, number), times_of(entries, number)};
  return section;
}

}  // namespace

Report report_of(const Comparison& comparison) {
  Report report;
  report.title = "Comparison";
  report.subtitle = "Tilth " + comparison.version;
  report.notes = summary_table(comparison).notes;
  std::size_t failed = 0;
  for (const RunOutcome& run : comparison.runs) failed += run.failure.empty() ? 0 : 1;
  report.facts = {{"runs", std::to_string(comparison.runs.size())}, {"failed", std::to_string(failed)}};
  std::vector<std::vector<MethodSummary>> by_source;
  for (MethodSummary& entry : summarize(comparison.runs)) {
    if (by_source.empty() || by_source.back().front().source != entry.source) by_source.emplace_back();
    by_source.back().push_back(std::move(entry));
  }
  for (std::size_t i = 0; i < by_source.size(); ++i)
    report.sections.push_back(section_of(by_source[i], std::to_string(i + 1)));
  return report;
}

}  // namespace tilth
