#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/plot/motion_curves.hpp>
#include <tilth/plot/plot_scale.hpp>
#include <tilth/report/run_sections.hpp>

namespace tilth {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian
constexpr double kMillimetres = 1000;                // in a metre
constexpr std::size_t kBins = 40;

/// value(row) of every scan over the time since the first.
template <class F>
Curve column(const RunRecord& record, const std::string& name, const F& value) {
  Curve curve{name, {}, {}, {}};
  for (const ScanRow& row : record.scans.rows) {
    curve.x.push_back(float(row.stamp - record.scans.rows.front().stamp));
    curve.y.push_back(float(value(row)));
  }
  return curve;
}

Plot scan_plot(std::string id, std::string title, Axis y, std::vector<Curve> curves) {
  Plot plot;
  plot.id = std::move(id);
  plot.title = std::move(title);
  plot.x = {"time", "s"};
  plot.y = std::move(y);
  plot.over_time = true;
  plot.curves = std::move(curves);
  return plot;
}

std::vector<Curve> stage_curves(const RunRecord& record) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < record.scans.stages.size(); ++i) {
    curves.push_back(column(record, record.scans.stages[i],
                            [i](const ScanRow& row) { return i < row.stage_ms.size() ? row.stage_ms[i] : 0.0; }));
  }
  return curves;
}

/// The standard deviations of three of the six directions, `first` the first of them.
std::vector<Curve> deviations(const RunRecord& record, int first, double unit) {
  std::vector<Curve> curves;
  for (int i = 0; i < 3; ++i) {
    curves.push_back(column(record, std::string(1, "xyz"[i]), [=](const ScanRow& row) {
      return unit * std::sqrt(std::max(0.0, row.covariance(first + i, first + i)));
    }));
  }
  return curves;
}

}  // namespace

Curve histogram_of(const std::vector<float>& values, std::size_t bins) {
  const Range range = range_of({extent(values)});
  const double width = (range.high - range.low) / double(bins);
  Curve curve{"count", {}, std::vector<float>(bins, 0.0F), {}};
  for (std::size_t i = 0; i <= bins; ++i) curve.x.push_back(float(range.low + width * double(i)));
  for (const float value : values) {
    const auto bin = std::size_t(std::max(0.0, (double(value) - range.low) / width));
    curve.y[std::min(bin, bins - 1)] += 1;
  }
  return curve;
}

Section time_section(const RunRecord& record) {
  Section section{"time", "Computing time", "Of the registration, on the machine named below.", {}, {}};
  std::vector<Curve> stages = stage_curves(record);
  Curve all = column(record, "registration as a whole", [](const ScanRow& row) { return row.register_ms; });
  Plot boxes;
  boxes.id = "stage_boxes";
  boxes.title = "Time of each stage, distribution";
  boxes.note = "Box: quartiles and median; whiskers: 1st and 99th percentile; dot: mean.";
  boxes.kind = PlotKind::boxes;
  boxes.y = {"time", "ms"};
  boxes.curves = stages;
  Plot histogram;
  histogram.id = "time_histogram";
  histogram.title = "Time of a scan, distribution";
  histogram.kind = PlotKind::histogram;
  histogram.x = {"time of a scan", "ms"};
  histogram.y = {"scans", ""};
  histogram.curves = {histogram_of(all.y, kBins)};
  section.plots = {scan_plot("scan_time", "Time of a scan", {"time", "ms"}, {std::move(all)}), std::move(histogram),
                   scan_plot("stage_time", "Time of each stage", {"time", "ms"}, std::move(stages)), std::move(boxes)};
  return section;
}

Section registration_section(const RunRecord& record) {
  const auto counts = [&](const char* name, std::size_t ScanRow::*field) {
    return column(record, name, [field](const ScanRow& row) { return double(row.*field); });
  };
  Section section{"registration", "Scans and their registration", "", {}, {}};
  section.plots = {scan_plot("features", "Features and matches", {"points", ""},
                             {counts("edges", &ScanRow::edges), counts("planes", &ScanRow::planes),
                              counts("looked up", &ScanRow::candidates), counts("matched", &ScanRow::matches)}),
                   scan_plot("iterations", "Iterations", {"iterations", ""},
                             {column(record, "iterations", [](const ScanRow& row) { return double(row.iterations); })}),
                   scan_plot("outliers", "Outliers removed", {"points", ""}, {counts("outliers", &ScanRow::outliers)}),
                   scan_plot("points", "Points of a scan", {"points", ""},
                             {counts("as read", &ScanRow::points_read), counts("in range", &ScanRow::points_in)})};
  return section;
}

Section confidence_section(const RunRecord& record) {
  Section section{
      "confidence", "Confidence", "As the registration itself estimates it, in the frame of the LiDAR.", {}, {}};
  section.plots = {
      scan_plot("deviation_translation", "Standard deviation, translation", {"deviation", "mm"},
                deviations(record, 3, kMillimetres)),
      scan_plot("deviation_rotation", "Standard deviation, rotation", {"deviation", "deg"},
                deviations(record, 0, kDegrees)),
      scan_plot("degenerate", "Directions that a scan does not determine", {"directions", ""},
                {column(record, "directions", [](const ScanRow& row) { return double(row.degenerate_directions); })}),
      scan_plot("residual", "Error left by the registration", {"half the weighted squares", ""},
                {column(record, "error", [](const ScanRow& row) { return row.error; })})};
  return section;
}

}  // namespace tilth
