#include <algorithm>

#include <tilth/evaluation/distribution.hpp>
#include <tilth/plot/svg_frame.hpp>

namespace tilth {
namespace {

constexpr double kWidth = 720, kPlotHeight = 220;        // [px] of the drawing; of the frame of lines
constexpr double kLeft = 62, kRight = 16, kBottom = 42;  // [px] round the frame, at least
constexpr double kLowestPath = 150, kHighestPath = 460;  // [px] of the frame of a path
constexpr double kHeadroom = 0.05;                       // share of the range left free at its ends

bool by_category(PlotKind kind) {
  return kind == PlotKind::boxes || kind == PlotKind::bars || kind == PlotKind::heat;
}

Range x_range(const Plot& plot) {
  if (plot.kind == PlotKind::boxes) return {0.0, std::max(1.0, double(plot.curves.size()))};
  if (by_category(plot.kind)) return {0.0, std::max(1.0, double(plot.categories.size()))};
  std::vector<Range> parts;
  for (const Curve& curve : plot.curves) parts.push_back(extent(curve.x));
  return range_of(parts);
}

Range y_range(const Plot& plot) {
  if (plot.kind == PlotKind::heat) return {0.0, std::max(1.0, double(plot.curves.size()))};
  std::vector<Range> parts;
  for (const Curve& curve : plot.curves) {
    if (plot.kind != PlotKind::boxes) parts.push_back(extent(curve.y));
    if (plot.kind != PlotKind::boxes || curve.y.empty()) continue;
    const BoxFigures box = box_figures(curve.y);
    parts.push_back({box.p01, box.p99});
  }
  for (const Mark& mark : plot.marks) parts.push_back({mark.value, mark.value});
  if (plot.band) parts.push_back({plot.band->low, plot.band->high});
  if (by_category(plot.kind) || plot.kind == PlotKind::histogram) parts.push_back({0.0, 0.0});
  if (std::all_of(parts.begin(), parts.end(), [](const Range& part) { return part.low == 0.0 && part.high == 0.0; }))
    return {0.0, 1.0};  // counts are not negative
  return padded(range_of(parts), kHeadroom);
}

/// Both ranges of a way widened, so that a metre is as long on either axis.
SvgFrame path_frame(SvgFrame frame, const Plot& plot) {
  std::vector<Range> parts;
  for (const Curve& curve : plot.curves) parts.push_back(extent(curve.y));
  const Range x = x_range(plot), y = range_of(parts);
  const double wide = frame.right - frame.left;
  const double needed = std::max(1e-3, 1 + 2 * kHeadroom);
  const double high = std::clamp(wide * (y.high - y.low) / (x.high - x.low), kLowestPath, kHighestPath);
  const double scale = std::min(wide / (x.high - x.low), high / (y.high - y.low)) / needed;  // [px/m]
  const double mx = (x.low + x.high) / 2, my = (y.low + y.high) / 2;
  frame.bottom = frame.top + high;
  frame.x = {{mx - wide / 2 / scale, mx + wide / 2 / scale}, frame.left, frame.right};
  frame.y = {{my - high / 2 / scale, my + high / 2 / scale}, frame.bottom, frame.top};
  return frame;
}

std::vector<std::string> y_names(const Plot& plot) {
  std::vector<std::string> names;
  if (plot.kind == PlotKind::heat) {
    for (const Curve& curve : plot.curves) names.push_back(curve.name);
    return names;
  }
  const Range range = y_range(plot);
  const double step = y_tick_step(plot, range);
  for (const double tick : ticks(range, step)) names.push_back(tick_text(tick, step));
  return names;
}

}  // namespace

double y_tick_step(const Plot& plot, const Range& range) {
  return tick_step(range, plot.kind == PlotKind::path ? 6 : 5);
}

double left_of(const Plot& plot) {
  constexpr double kName = 24, kGap = 8, kLetter = 6.2;  // [px] of the axis' name, beside it, of a letter
  std::size_t longest = 0;
  for (const std::string& name : y_names(plot)) longest = std::max(longest, name.size());
  return std::max(kLeft, kName + kGap + kLetter * double(longest));
}

SvgFrame frame_of(const Plot& plot, double head) {
  SvgFrame frame;
  frame.width = kWidth;
  frame.left = left_of(plot);
  frame.right = kWidth - kRight;
  frame.top = head;
  frame.bottom = head + kPlotHeight;
  frame.x = {x_range(plot), frame.left, frame.right};
  frame.y = {y_range(plot), frame.bottom, frame.top};
  if (plot.kind == PlotKind::path) frame = path_frame(frame, plot);
  frame.height = frame.bottom + kBottom;
  return frame;
}

}  // namespace tilth
