#include <algorithm>
#include <cstdio>
#include <numbers>

#include <tilth/evaluation/pose_pairs.hpp>
#include <tilth/plot/motion_curves.hpp>
#include <tilth/report/run_sections.hpp>

namespace tilth {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian
constexpr std::size_t kBins = 40;

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value);
  return text;
}

std::vector<std::string> row(const std::string& name, const Metric& m) {
  std::vector<std::string> cells{name};
  for (const double value : {m.max, m.mean, m.median, m.min, m.rmse, m.std}) cells.push_back(digits(value));
  return cells;
}

const std::vector<std::string> kColumns{"", "max", "mean", "median", "min", "RMSE", "std"};

Table ape_table(const Evaluation& by_start, const JudgedRun& judged) {
  Table table{"Absolute pose error", kColumns, {}, true};
  table.rows.push_back(row("translation [m], " + judged.alignment, judged.aligned.ape.translation));
  table.rows.push_back(row("rotation [deg], " + judged.alignment, scaled(judged.aligned.ape.rotation, kDegrees)));
  if (judged.aligned.options.align == by_start.options.align) return table;
  table.rows.push_back(row("translation [m], first poses equal", by_start.ape.translation));
  table.rows.push_back(row("rotation [deg], first poses equal", scaled(by_start.ape.rotation, kDegrees)));
  return table;
}

std::string pair_text(const PairOptions& pairs) {
  char text[64];
  std::snprintf(text, sizeof text, "%g %s apart", pairs.delta, kDeltaUnitNames[std::size_t(pairs.unit)].data());
  return text;
}

Table rpe_table(const Evaluation& e) {
  Table table{"Relative pose error, pairs " + pair_text(e.options.rpe.pairs), kColumns, {}, true};
  table.rows.push_back(row("translation [m]", e.rpe.translation));
  table.rows.push_back(row("rotation [deg]", scaled(e.rpe.rotation, kDegrees)));
  return table;
}

Plot ape_plot(const JudgedRun& judged, double start) {
  const Metric& m = judged.aligned.ape.translation;
  Plot plot;
  plot.id = "ape";
  plot.title = "Absolute pose error over time";
  plot.note = "Distance of each position from its true one; aligned: " + judged.alignment +
              ". The strip is one standard deviation to either side of the mean.";
  plot.x = {"time", "s"};
  plot.y = {"APE", "m"};
  plot.over_time = true;
  plot.curves = {{"APE", times_of(judged.aligned.matches.estimate, start), floats(m.errors), {}}};
  plot.marks = {
      {"RMSE " + digits(m.rmse), m.rmse}, {"median " + digits(m.median), m.median}, {"mean " + digits(m.mean), m.mean}};
  plot.band = {"std " + digits(m.std), std::max(0.0, m.mean - m.std), m.mean + m.std};
  return plot;
}

Plot error_along_path(const JudgedRun& judged) {
  Plot plot;
  plot.id = "ape_path";
  plot.title = "Absolute pose error along the way";
  plot.kind = PlotKind::path;
  plot.x = {"x", "m"};
  plot.y = {"y", "m"};
  plot.shade = {"APE", "m"};
  plot.curves = {path_curve(judged.truth_in_world, "APE")};
  plot.curves[0].shade = floats(judged.aligned.ape.translation.errors);
  return plot;
}

Plot error_histogram(const JudgedRun& judged) {
  Plot plot;
  plot.id = "ape_histogram";
  plot.title = "Distribution of the absolute pose error";
  plot.kind = PlotKind::histogram;
  plot.x = {"APE", "m"};
  plot.y = {"poses", ""};
  plot.curves = {histogram_of(floats(judged.aligned.ape.translation.errors), kBins)};
  return plot;
}

Plot rpe_plot(const Evaluation& e, double start, bool rotation) {
  const Trajectory& path = e.options.rpe.pairs_from_truth ? e.matches.truth : e.matches.estimate;
  Curve curve{"RPE", {}, floats(rotation ? scaled(e.rpe.rotation, kDegrees).errors : e.rpe.translation.errors), {}};
  for (const PosePair& pair : pose_pairs(path, e.options.rpe.pairs)) {
    curve.x.push_back(float(path[pair.second].stamp - start));
  }
  Plot plot;
  plot.id = rotation ? "rpe_rotation" : "rpe";
  plot.title = rotation ? "Relative pose error, rotation" : "Relative pose error, translation";
  plot.note = "Pairs " + pair_text(e.options.rpe.pairs) + ", at the time of the second.";
  plot.x = {"time", "s"};
  plot.y = {"RPE", rotation ? "deg" : "m"};
  plot.over_time = true;
  plot.curves = {std::move(curve)};
  return plot;
}

}  // namespace

Section accuracy_section(const RunRecord& record, const JudgedRun& judged) {
  const double start = record.trajectory.front().stamp;
  Section section{"accuracy", "Accuracy", "Held against the truth with the measures of evo.", {}, {}};
  section.tables = {ape_table(*record.evaluation, judged), rpe_table(judged.aligned)};
  section.plots = {ape_plot(judged, start), error_along_path(judged), error_histogram(judged),
                   rpe_plot(judged.aligned, start, false), rpe_plot(judged.aligned, start, true)};
  return section;
}

}  // namespace tilth
