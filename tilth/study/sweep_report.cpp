// The report of a sweep, from its table: a curve a source over each parameter, heat maps over two.
#include <algorithm>
#include <limits>

#include <tilth/io/text_lines.hpp>
#include <tilth/report/report.hpp>
#include <tilth/study/sweep.hpp>

namespace tilth {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

using Row = std::vector<Figure>;

/// The values of a parameter (its column) in the order of their first row; of the sources in column 0.
std::vector<std::string> distinct(const FigureTable& table, std::size_t column) {
  std::vector<std::string> words;
  for (const Row& row : table.rows) {
    if (std::find(words.begin(), words.end(), row[column].word) == words.end()) words.push_back(row[column].word);
  }
  return words;
}

/// The columns that any source has a figure for, counts of runs not among them.
std::vector<std::size_t> figure_columns(const Sweep& sweep, const FigureTable& table) {
  std::vector<std::size_t> columns;
  for (std::size_t column = 1 + sweep.parameters.size(); column < table.columns.size(); ++column) {
    const std::string& key = table.columns[column].key;
    const bool known =
        std::any_of(table.rows.begin(), table.rows.end(), [&](const Row& row) { return row[column].number; });
    if (known && key != "runs" && key != "failed") columns.push_back(column);
  }
  return columns;
}

/// The value at which a parameter is held while another one changes.
std::string held_value(const Sweep& sweep, const FigureTable& table, std::size_t parameter) {
  const std::vector<std::string> values = distinct(table, 1 + parameter);
  const std::string& base = sweep.base.at(parameter);
  return std::find(values.begin(), values.end(), base) != values.end() ? base : values.front();
}

/// The rows in which all parameters but `parameter` are held.
std::vector<Row> rows_alone(const Sweep& sweep, const FigureTable& table, std::size_t parameter) {
  std::vector<std::string> held;
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p) held.push_back(held_value(sweep, table, p));
  std::vector<Row> rows;
  for (const Row& row : table.rows) {
    bool alone = true;
    for (std::size_t p = 0; p < held.size(); ++p) alone = alone && (p == parameter || row[1 + p].word == held[p]);
    if (alone) rows.push_back(row);
  }
  return rows;
}

/// A figure of each source over a parameter: by its values where all are numbers, else side by side.
Plot plot_over(const FigureTable& table, const std::vector<Row>& rows, std::size_t parameter, std::size_t column) {
  const std::size_t at = 1 + parameter;
  Plot plot;
  plot.id = std::string("over").append(std::to_string(at)).append("_").append(table.columns[column].key);
  plot.title = table.columns[column].title;
  plot.x = {table.columns[at].title, ""};
  plot.y = {table.columns[column].title, ""};
  const std::vector<std::string> values = distinct({"", {}, rows, {}}, at);
  const bool numbers =
      std::all_of(values.begin(), values.end(), [](const auto& word) { return to_double(word).has_value(); });
  plot.kind = numbers ? PlotKind::lines : PlotKind::bars;
  if (!numbers) plot.categories = values;
  for (const std::string& source : distinct(table, 0)) {
    Curve curve{source, {}, numbers ? std::vector<float>{} : std::vector<float>(values.size(), kUnknown), {}};
    for (const Row& row : rows) {
      if (row[0].word != source || !row[column].number) continue;
      const auto place = std::size_t(std::find(values.begin(), values.end(), row[at].word) - values.begin());
      const auto figure = float(*row[column].number);
      if (numbers) {
        curve.x.push_back(float(*to_double(row[at].word)));
        curve.y.push_back(figure);
      } else {
        curve.y[place] = figure;
      }
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

Section alone_section(const Sweep& sweep, const FigureTable& table, std::size_t parameter) {
  Section section{
      std::string("alone_").append(std::to_string(parameter + 1)), sweep.parameters[parameter] + " alone", "", {}, {}};
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p)
    if (p != parameter) section.note += sweep.parameters[p] + " = " + held_value(sweep, table, p) + " ";
  const std::vector<Row> rows = rows_alone(sweep, table, parameter);
  for (const std::size_t column : figure_columns(sweep, table))
    section.plots.push_back(plot_over(table, rows, parameter, column));
  return section;
}

/// The mean of a column over the rows of a source with these values of the first two parameters.
float cell_of(const FigureTable& table, const std::vector<std::string>& words, std::size_t column) {
  double sum = 0, count = 0;
  for (const Row& row : table.rows) {
    if (row[0].word != words[0] || row[1].word != words[1] || row[2].word != words[2] || !row[column].number) continue;
    sum += *row[column].number;
    ++count;
  }
  return count > 0 ? float(sum / count) : kUnknown;
}

Plot heat_plot(const FigureTable& table, const std::string& source, const std::string& number, std::size_t column) {
  Plot plot;
  plot.id = std::string("heat_").append(number).append("_").append(table.columns[column].key);
  plot.title = table.columns[column].title;
  plot.kind = PlotKind::heat;
  plot.x = {table.columns[1].title, ""};
  plot.y = {table.columns[2].title, ""};
  plot.categories = distinct(table, 1);
  for (const std::string& y : distinct(table, 2)) {
    Curve row{y, {}, {}, {}};
    for (const std::string& x : plot.categories) row.y.push_back(cell_of(table, {source, x, y}, column));
    plot.curves.push_back(std::move(row));
  }
  return plot;
}

/// The rows of a source, without its name and without columns that it has no figure in.
Table table_of(const FigureTable& table, const std::string& source) {
  const std::vector<std::vector<std::string>> words = table_words(table);
  Table shown{"Means over the seeds", {}, {}, true};
  std::vector<std::size_t> columns;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    if (std::any_of(words.begin() + 1, words.end(), [&](const auto& row) { return row[c] != "-"; }))
      columns.push_back(c);
  }
  for (const std::size_t c : columns) shown.columns.push_back(words[0][c]);
  for (std::size_t r = 1; r < words.size(); ++r) {
    if (words[r][0] != source) continue;
    shown.rows.emplace_back();
    for (const std::size_t c : columns) shown.rows.back().push_back(words[r][c]);
  }
  return shown;
}

}  // namespace

Report report_of(const Sweep& sweep) {
  const FigureTable table = sweep_table(sweep);
  Report report;
  report.title = "Sweep of " + sweep.pipeline;
  report.subtitle = "Tilth " + sweep.version;
  report.notes = table.notes;
  const auto failed = std::count_if(sweep.runs.begin(), sweep.runs.end(),
                                    [](const SweepRun& run) { return !run.outcome.failure.empty(); });
  report.facts = {{"runs", std::to_string(sweep.runs.size())}, {"failed", std::to_string(failed)}};
  if (sweep.runs.empty()) return report;
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p) report.sections.push_back(alone_section(sweep, table, p));
  std::size_t number = 0;
  for (const std::string& source : distinct(table, 0)) {
    ++number;
    Section section{std::string("source_").append(std::to_string(number)), source, "", {table_of(table, source)}, {}};
    for (const std::size_t column : figure_columns(sweep, table)) {
      if (sweep.grid && sweep.parameters.size() > 1)
        section.plots.push_back(heat_plot(table, source, std::to_string(number), column));
    }
    report.sections.push_back(std::move(section));
  }
  return report;
}

}  // namespace tilth
