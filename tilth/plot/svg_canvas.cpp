#include <cmath>
#include <cstdio>

#include <tilth/plot/svg_canvas.hpp>

namespace tilth {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// To a hundredth of a pixel, without idle zeros.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string out = text;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + number(value) + "\"";
}

std::string class_of(std::string_view style) {
  return " class=\"" + std::string(style) + "\"";
}

/// Bytes of the well-formed UTF-8 character at the start of `text`; zero where there is none.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xC2 && first < 0xE0   ? 2
                           : first >= 0xE0 && first < 0xF0 ? 3
                           : first >= 0xF0 && first < 0xF5 ? 4
                                                           : 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  }
  const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool outside = (first == 0xED && byte(1) >= 0xA0) || (first == 0xF4 && byte(1) >= 0x90);
  const bool no_character = first == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE;
  return overlong || outside || no_character ? 0 : size;
}

}  // namespace

std::string markup_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const char c = text.front();
    const bool control = size == 1 && ((c >= 0 && c < ' ' && c != '\n' && c != '\t') || c == 0x7F);
    if (size == 0 || control)
      out += kReplacement;
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += text.substr(0, size);
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

void SvgCanvas::line(SvgPoint from, SvgPoint to, std::string_view style) {
  elements_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
               attribute("y2", to.y) + class_of(style) + "/>\n";
}

void SvgCanvas::polyline(const std::vector<SvgPoint>& points, std::string_view style) {
  elements_ += "<polyline points=\"";
  for (const SvgPoint& p : points) elements_.append(number(p.x)).append(",").append(number(p.y)).append(" ");
  elements_.append("\"").append(class_of(style)).append("/>\n");
}

void SvgCanvas::shaded_line(SvgPoint from, SvgPoint to, std::string_view color) {
  elements_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
               attribute("y2", to.y) + " class=\"shaded\" stroke=\"" + std::string(color) + "\"/>\n";
}

void SvgCanvas::box(SvgPoint corner, SvgPoint opposite, std::string_view style) {
  elements_ += "<rect" + attribute("x", std::min(corner.x, opposite.x)) +
               attribute("y", std::min(corner.y, opposite.y)) + attribute("width", std::abs(opposite.x - corner.x)) +
               attribute("height", std::abs(opposite.y - corner.y)) + class_of(style) + "/>\n";
}

void SvgCanvas::shaded_box(SvgPoint corner, SvgPoint opposite, std::string_view color) {
  elements_ += "<rect" + attribute("x", std::min(corner.x, opposite.x)) +
               attribute("y", std::min(corner.y, opposite.y)) + attribute("width", std::abs(opposite.x - corner.x)) +
               attribute("height", std::abs(opposite.y - corner.y)) + " class=\"cell\" fill=\"" + std::string(color) +
               "\"/>\n";
}

void SvgCanvas::dot(SvgPoint at, double radius, std::string_view style) {
  elements_ +=
      "<circle" + attribute("cx", at.x) + attribute("cy", at.y) + attribute("r", radius) + class_of(style) + "/>\n";
}

void SvgCanvas::text(SvgPoint at, std::string_view words, std::string_view style) {
  elements_ +=
      "<text" + attribute("x", at.x) + attribute("y", at.y) + class_of(style) + ">" + markup_text(words) + "</text>\n";
}

void SvgCanvas::turned_text(SvgPoint at, std::string_view words, std::string_view style) {
  elements_ += "<text transform=\"translate(" + number(at.x) + "," + number(at.y) + ") rotate(-90)\"" +
               class_of(style) + ">" + markup_text(words) + "</text>\n";
}

std::string_view svg_beginning() {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" viewBox=\"0 0 ";
}

std::string SvgCanvas::svg(std::string_view title, std::string_view style) const {
  std::string out(svg_beginning());
  out.append(number(width_)).append(" ").append(number(height_)).append("\"");
  if (!style.empty()) out += attribute("width", width_) + attribute("height", height_);
  out += ">\n<title>" + markup_text(title) + "</title>\n";
  if (!style.empty()) out += "<style>" + std::string(style) + "</style>\n";
  if (!style.empty()) out += "<rect width=\"100%\" height=\"100%\" class=\"paper\"/>\n";
  return out + elements_ + "</svg>\n";
}

}  // namespace tilth
