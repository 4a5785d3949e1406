#include <array>
#include <cmath>
#include <cstdio>

#include <tilth/plot/svg_frame.hpp>

namespace tilth {
namespace {

constexpr double kDark = 0.6;  // share of the range from which on white is read more easily
constexpr const char* kUnknown = "#e6e6e6";

/// From pale yellow to dark red.
std::string heat_color(double ratio) {
  const std::array<int, 3> rgb{int(255 - 90 * ratio * ratio), int(247 - 215 * ratio), int(200 - 160 * ratio)};
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", rgb[0] & 0xff, rgb[1] & 0xff, rgb[2] & 0xff);
  return text.data();
}

void draw_cell(SvgCanvas& canvas, const SvgFrame& frame, SvgPoint corner, double value, const Range& range) {
  const bool known = std::isfinite(value);
  const double ratio = known ? (value - range.low) / (range.high - range.low) : 0.0;
  canvas.shaded_box(frame.at(corner.x, corner.y), frame.at(corner.x + 1, corner.y + 1),
                    known ? heat_color(ratio) : kUnknown);
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%.4g", value);
  const SvgPoint middle = frame.at(corner.x + 0.5, corner.y + 0.5);
  canvas.text({middle.x, middle.y + 4}, known ? number.data() : "-",
              known && ratio > kDark ? "value light middle" : "value middle");
}

}  // namespace

void draw_heat(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot) {
  std::vector<Range> parts;
  for (const Curve& row : plot.curves) parts.push_back(extent(row.y));
  const Range range = range_of(parts);
  for (std::size_t row = 0; row < plot.curves.size(); ++row) {
    const std::vector<float>& cells = plot.curves[row].y;
    for (std::size_t i = 0; i < cells.size(); ++i)
      draw_cell(canvas, frame, {double(i), double(row)}, double(cells[i]), range);
  }
}

}  // namespace tilth
