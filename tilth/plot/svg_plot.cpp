#include <algorithm>

#include <tilth/plot/svg_frame.hpp>
#include <tilth/plot/svg_plot.hpp>
#include <tilth/plot/svg_style.hpp>

namespace tilth {
namespace {

constexpr double kTitle = 26, kLegendRow = 18, kTop = 10;  // [px] heights above the frame
constexpr double kLetter = 6.4;                            // [px] mean width of a letter of the legend
constexpr double kNameRow = 14;                            // [px] between two rows of names
constexpr double kSwatch = 20, kGap = 16;                  // [px] of the legend

struct LegendEntry {
  std::string name, style;
  SvgPoint at;
};

std::vector<LegendEntry> entries_of(const Plot& plot) {
  std::vector<LegendEntry> entries;
  const bool named = plot.curves.size() > 1 && plot.kind != PlotKind::boxes && plot.kind != PlotKind::heat;
  for (std::size_t c = 0; named && c < plot.curves.size(); ++c) {
    entries.push_back({plot.curves[c].name, "curve " + curve_style(plot, c), {}});
  }
  for (std::size_t m = 0; m < plot.marks.size(); ++m) {
    entries.push_back({plot.marks[m].name, "mark m" + std::to_string(m % 4), {}});
  }
  if (plot.band) entries.push_back({plot.band->name, "bandline", {}});
  if (plot.alarm) entries.push_back({plot.alarm->name, "alarmline", {}});
  if (plot.dots && !plot.dots->y.empty()) entries.push_back({plot.dots->name, "landmarks", {}});
  if (plot.links && !plot.links->y.empty()) entries.push_back({plot.links->name, "link", {}});
  return entries;
}

std::size_t letters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  return count;
}

/// Entries side by side in rows, below `top`; returns where the rows end.
double place(std::vector<LegendEntry>& entries, double top, double left, double right) {
  double x = left, y = top + kLegendRow / 2;
  for (LegendEntry& entry : entries) {
    const double width = kSwatch + kLetter * double(letters(entry.name)) + kGap;
    if (x > left && x + width > right) {
      x = left;
      y += kLegendRow;
    }
    entry.at = {x, y};
    x += width;
  }
  return entries.empty() ? top : y + kLegendRow / 2 + 4;
}

void draw_legend(SvgCanvas& canvas, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    canvas.line(entry.at, {entry.at.x + kSwatch - 6, entry.at.y}, entry.style);
    canvas.text({entry.at.x + kSwatch, entry.at.y + 4}, entry.name, "legend");
  }
}

void draw_x_axis(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  const double below = frame.bottom + 16;
  canvas.text({(frame.left + frame.right) / 2, frame.bottom + 34}, axis_text(plot.x), "label middle");
  if (plot.kind == PlotKind::boxes || plot.kind == PlotKind::bars || plot.kind == PlotKind::heat) {
    const std::size_t count = plot.kind == PlotKind::boxes ? plot.curves.size() : plot.categories.size();
    const auto name = [&](std::size_t i) {
      return plot.kind == PlotKind::boxes ? plot.curves[i].name : plot.categories[i];
    };
    std::size_t longest = 0;
    for (std::size_t i = 0; i < count; ++i) longest = std::max(longest, letters(name(i)));
    const bool crowded = kLetter * double(longest + 1) > frame.x(1) - frame.x(0);
    for (std::size_t i = 0; i < count; ++i)  // every other one a line lower where they would meet
      canvas.text({frame.x(double(i) + 0.5), below + (crowded && i % 2 == 1 ? kNameRow : 0)}, name(i), "tick middle");
    return;
  }
  const double step = tick_step(frame.x.range, 9);
  for (const double tick : ticks(frame.x.range, step)) {
    canvas.line({frame.x(tick), frame.top}, {frame.x(tick), frame.bottom}, "grid");
    canvas.text({frame.x(tick), below}, tick_text(tick, step), "tick middle");
  }
}

void draw_y_axis(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  const bool heat = plot.kind == PlotKind::heat;
  for (std::size_t c = 0; heat && c < plot.curves.size(); ++c)
    canvas.text({frame.left - 6, frame.y(double(c) + 0.5) + 4}, plot.curves[c].name, "tick end");
  const double step = y_tick_step(plot, frame.y.range);
  for (const double tick : heat ? std::vector<double>{} : ticks(frame.y.range, step)) {
    canvas.line({frame.left, frame.y(tick)}, {frame.right, frame.y(tick)}, "grid");
    canvas.text({frame.left - 6, frame.y(tick) + 4}, tick_text(tick, step), "tick end");
  }
  canvas.turned_text({14, (frame.top + frame.bottom) / 2}, axis_text(plot.y), "label middle");
}

/// A strip of colours with the values at its ends, at the upper right.
void draw_shades(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot, double y) {
  Range range;
  for (const Curve& curve : plot.curves) {
    if (!curve.shade.empty()) range = range_of({extent(curve.shade)});
  }
  const double step = (range.high - range.low) / 100, left = frame.right - 190, width = 100;
  for (int i = 0; i < 25; ++i) {
    canvas.shaded_line({left + width * i / 25, y}, {left + width * (i + 1) / 25, y}, shade_color(i / 24.0));
  }
  canvas.text({left - 8, y + 4}, axis_text(plot.shade) + "  " + tick_text(range.low, step), "legend end");
  canvas.text({left + width + 8, y + 4}, tick_text(range.high, step), "legend");
}

std::string drawn(const Plot& plot, bool file) {
  double head = kTop + (file ? kTitle : 0);
  const bool shaded = !plot.shade.label.empty();
  std::vector<LegendEntry> entries = shaded ? std::vector<LegendEntry>{} : entries_of(plot);
  const double legend_top = head - 6;
  head = place(entries, legend_top, left_of(plot), 704) + (shaded ? kLegendRow : 0);
  const SvgFrame frame = frame_of(plot, head);
  SvgCanvas canvas(frame.width, frame.height);
  if (file) canvas.text({frame.left, 22}, plot.title, "title");
  draw_x_axis(canvas, frame, plot);
  draw_y_axis(canvas, frame, plot);
  draw_content(canvas, frame, plot);
  canvas.box({frame.left, frame.top}, {frame.right, frame.bottom}, "frame");
  draw_legend(canvas, entries);
  if (shaded) draw_shades(canvas, frame, plot, legend_top + kLegendRow / 2);
  return canvas.svg(plot.title, file ? svg_style() : "");
}

}  // namespace

std::string axis_text(const Axis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " [" + axis.unit + "]";
}

std::string svg_inline(const Plot& plot) {
  return drawn(plot, false);
}

std::string svg_file(const Plot& plot) {
  return drawn(plot, true);
}

}  // namespace tilth
