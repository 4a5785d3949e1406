#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <tilth/output/heat_map.hpp>
#include <tilth/output/svg_canvas.hpp>

namespace tilth {
namespace {

constexpr int kCellWidth = 76, kCellHeight = 34, kLeft = 130, kTop = 64, kBelow = 62;  // [px]

std::string text_at(double x, double y, const std::string& anchor, const std::string& words) {
  std::array<char, 160> head{};
  std::snprintf(head.data(), head.size(), "<text x=\"%g\" y=\"%g\" text-anchor=\"%s\">", x, y, anchor.c_str());
  return head.data() + markup_text(words) + "</text>\n";
}

std::array<double, 2> range_of(const HeatMap& map) {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& row : map.cells) {
    for (const double value : row) {
      if (!std::isfinite(value)) continue;
      range = {std::min(range[0], value), std::max(range[1], value)};
    }
  }
  return range;
}

/// From pale yellow to dark red, by the share of the range.
std::string cell_at(double x, double y, double value, const std::array<double, 2>& range) {
  const bool known = std::isfinite(value);
  const double share = known && range[1] > range[0] ? (value - range[0]) / (range[1] - range[0]) : 0;
  const std::array<int, 3> colour{int(255 - 90 * share * share), int(247 - 215 * share), int(200 - 160 * share)};
  std::array<char, 200> box{};
  std::snprintf(box.data(), box.size(),
                "<rect x=\"%g\" y=\"%g\" width=\"%d\" height=\"%d\" fill=\"rgb(%d,%d,%d)\" stroke=\"white\"/>\n", x, y,
                kCellWidth, kCellHeight, known ? colour[0] : 230, known ? colour[1] : 230, known ? colour[2] : 230);
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%.4g", value);
  const std::string words = known ? number.data() : "-";
  const std::string text = text_at(x + kCellWidth / 2.0, y + kCellHeight / 2.0 + 4, "middle", words);
  return box.data() + (share > 0.6 ? "<g fill=\"white\">" + text + "</g>" : text);
}

}  // namespace

std::string heat_map_svg(const HeatMap& map) {
  const int width = kLeft + kCellWidth * int(map.x_values.size()) + 24;
  const int height = kTop + kCellHeight * int(map.y_values.size()) + kBelow;
  std::array<char, 200> head{};
  std::snprintf(head.data(), head.size(),
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\" "
                "font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                width, height);
  std::string svg = head.data() + text_at(width / 2.0, 24, "middle", map.title);
  const std::array<double, 2> range = range_of(map);
  for (std::size_t row = 0; row < map.cells.size(); ++row) {
    const double y = kTop + kCellHeight * double(row);
    svg += text_at(kLeft - 8, y + kCellHeight / 2.0 + 4, "end", map.y_values[row]);
    for (std::size_t column = 0; column < map.cells[row].size(); ++column)
      svg += cell_at(kLeft + kCellWidth * double(column), y, map.cells[row][column], range);
  }
  const double below = kTop + kCellHeight * double(map.y_values.size());
  for (std::size_t column = 0; column < map.x_values.size(); ++column)
    svg += text_at(kLeft + kCellWidth * (double(column) + 0.5), below + 18, "middle", map.x_values[column]);
  svg += text_at(kLeft + kCellWidth * double(map.x_values.size()) / 2.0, below + 42, "middle", map.x_name);
  return svg + text_at(8, kTop - 14, "start", map.y_name) + "</svg>\n";
}

}  // namespace tilth
