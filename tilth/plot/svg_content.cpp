#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include <tilth/evaluation/distribution.hpp>
#include <tilth/plot/curve_thinning.hpp>
#include <tilth/plot/svg_frame.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostPoints = 1400;   // of a line: two for each pixel of its width
constexpr std::size_t kMostSegments = 500;  // of a path, each with a colour of its own
constexpr std::size_t kColors = 8;
constexpr double kBarRatio = 0.8;  // of the place of a category that its bars fill

/// The numbers of the curves as they are drawn: the truth first, below the others, then those behind.
std::vector<std::size_t> drawing_order(const Plot& plot) {
  std::vector<std::size_t> order(plot.curves.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto rank = [&](std::size_t c) { return plot.curves[c].truth ? 0 : plot.curves[c].behind ? 1 : 2; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

void draw_lines(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  for (const std::size_t c : drawing_order(plot)) {
    const Curve curve = thinned(plot.curves[c], kMostPoints, plot.kind);
    std::vector<SvgPoint> points;
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) points.push_back(frame.at(curve.x[i], curve.y[i]));
    }
    canvas.polyline(points, "curve " + curve_style(plot, c));
  }
}

void draw_shaded(SvgCanvas& canvas, const SvgFrame& frame, const Curve& whole) {
  const Curve curve = thinned(whole, kMostSegments, PlotKind::path);
  const Range range = range_of({extent(whole.shade)});
  for (std::size_t i = 1; i < curve.y.size(); ++i) {
    const double ratio = (double(curve.shade[i]) - range.low) / (range.high - range.low);
    canvas.shaded_line(frame.at(curve.x[i - 1], curve.y[i - 1]), frame.at(curve.x[i], curve.y[i]), shade_color(ratio));
  }
}

void draw_landmarks(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  for (std::size_t i = 1; plot.links && i < plot.links->y.size(); i += 2) {
    const Curve& ends = *plot.links;
    canvas.line(frame.at(ends.x[i - 1], ends.y[i - 1]), frame.at(ends.x[i], ends.y[i]), "link");
  }
  for (std::size_t i = 0; plot.dots && i < plot.dots->y.size(); ++i)
    canvas.dot(frame.at(plot.dots->x[i], plot.dots->y[i]), 2, "landmark");
}

void draw_path(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  const bool shaded =
      std::any_of(plot.curves.begin(), plot.curves.end(), [](const Curve& c) { return !c.shade.empty(); });
  if (!shaded) draw_lines(canvas, frame, plot);
  for (const Curve& curve : plot.curves) {
    if (!curve.shade.empty()) draw_shaded(canvas, frame, curve);
  }
  draw_landmarks(canvas, frame, plot);
  const Curve& first = plot.curves.front();
  if (!first.y.empty()) canvas.dot(frame.at(first.x.front(), first.y.front()), 4, "start");
}

void draw_boxes(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const BoxFigures box = box_figures(plot.curves[c].y);
    const double middle = double(c) + 0.5, half = 0.28;
    const std::string style = curve_style(plot, c);
    canvas.line(frame.at(middle, box.p01), frame.at(middle, box.p99), "whisker");
    canvas.box(frame.at(middle - half, box.q1), frame.at(middle + half, box.q3), "box " + style);
    canvas.line(frame.at(middle - half, box.median), frame.at(middle + half, box.median), "median");
    canvas.dot(frame.at(middle, box.mean), 3, "mean");
  }
}

void draw_bars(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  const double width = kBarRatio / double(plot.curves.size());
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    for (std::size_t i = 0; i < plot.curves[c].y.size(); ++i) {
      const double left = double(i) + (1 - kBarRatio) / 2 + width * double(c);
      canvas.box(frame.at(left, 0), frame.at(left + width, plot.curves[c].y[i]), "bar " + curve_style(plot, c));
    }
  }
}

/// As wide as a pixel at least, so that a single scan is seen.
void draw_alarm(SvgCanvas& canvas, const SvgFrame& frame, const Alarm& alarm) {
  for (const auto& [from, to] : alarm.spans) {
    const double left = std::max(frame.left, frame.x(from) - 0.5), right = std::min(frame.right, frame.x(to) + 0.5);
    canvas.box({left, frame.bottom}, {right, frame.top}, "alarm");
  }
}

void draw_histogram(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  for (const Curve& curve : plot.curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      canvas.box(frame.at(curve.x[i], 0), frame.at(curve.x[i + 1], curve.y[i]), "bar s0");
    }
  }
}

}  // namespace

std::string curve_style(const Plot& plot, std::size_t n) {
  if (plot.curves[n].truth) return "truth";
  return std::string("s").append(std::to_string(n % kColors));
}

std::string shade_color(double ratio) {
  constexpr std::array<std::array<double, 3>, 4> kStops{
      {{37, 96, 168}, {52, 168, 160}, {240, 180, 60}, {205, 50, 45}}};  // blue, teal, amber, red
  const double at = std::clamp(ratio, 0.0, 1.0) * double(kStops.size() - 1);
  const std::size_t low = std::min(std::size_t(at), kStops.size() - 2);
  int rgb[3];
  for (std::size_t i = 0; i < 3; ++i) rgb[i] = int(std::lerp(kStops[low][i], kStops[low + 1][i], at - double(low)));
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", rgb[0] & 0xff, rgb[1] & 0xff, rgb[2] & 0xff);
  return text;
}

void draw_content(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  if (plot.band) canvas.box({frame.left, frame.y(plot.band->low)}, {frame.right, frame.y(plot.band->high)}, "band");
  if (plot.alarm) draw_alarm(canvas, frame, *plot.alarm);
  switch (plot.kind) {
    case PlotKind::lines: draw_lines(canvas, frame, plot); break;
    case PlotKind::path: draw_path(canvas, frame, plot); break;
    case PlotKind::boxes: draw_boxes(canvas, frame, plot); break;
    case PlotKind::bars: draw_bars(canvas, frame, plot); break;
    case PlotKind::histogram: draw_histogram(canvas, frame, plot); break;
    case PlotKind::heat: draw_heat(canvas, frame, plot); break;
  }
  for (std::size_t m = 0; m < plot.marks.size(); ++m) {
    const double y = frame.y(plot.marks[m].value);
    canvas.line({frame.left, y}, {frame.right, y}, "mark m" + std::to_string(m % 4));
  }
}

}  // namespace tilth
