// A drawing in SVG 1.1: elements are added one by one. Colours are classes, which the sheet of svg_style() or that of a
// page gives their meaning. O(elements).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tilth {

struct SvgPoint {
  double x = 0.0, y = 0.0;  ///< [px] right and down
};

/// `text` for the inside of an element or a quoted attribute of HTML or XML: & < > " ' become references; what XML
/// does not allow (control characters, broken UTF-8) becomes U+FFFD.
std::string markup_text(std::string_view text);

/// How every drawing of SvgCanvas begins, and hardly another.
std::string_view svg_beginning();

class SvgCanvas {
 public:
  SvgCanvas(double width, double height) : width_(width), height_(height) {}

  void line(SvgPoint from, SvgPoint to, std::string_view style);
  void polyline(const std::vector<SvgPoint>& points, std::string_view style);
  /// A piece of a way in a colour of its own, "#rrggbb".
  void shaded_line(SvgPoint from, SvgPoint to, std::string_view color);
  void box(SvgPoint corner, SvgPoint opposite, std::string_view style);
  /// A cell in a colour of its own, "#rrggbb".
  void shaded_box(SvgPoint corner, SvgPoint opposite, std::string_view color);
  void dot(SvgPoint at, double radius, std::string_view style);
  void text(SvgPoint at, std::string_view words, std::string_view style);
  void turned_text(SvgPoint at, std::string_view words, std::string_view style);  ///< reads upwards

  double width() const { return width_; }
  double height() const { return height_; }

  /// The whole drawing; `title` is what screen readers say, `style` the text of its sheet, empty where the page has it.
  std::string svg(std::string_view title, std::string_view style) const;

 private:
  double width_, height_;
  std::string elements_;
};

}  // namespace tilth
