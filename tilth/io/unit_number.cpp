#include <array>
#include <charconv>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/core/options.hpp>
#include <tilth/io/unit_number.hpp>

namespace tilth {

std::string text_of(double value, const FileUnit& unit) {
  std::array<char, 48> text{};
  char* last = text.data();
  for (const int digits : {6, 17, 18, 19, 20, 21}) {
    last = std::to_chars(text.data(), text.data() + text.size(), static_cast<long double>(value) / unit.size,
                         std::chars_format::general, digits)
               .ptr;
    long double back = 0;
    std::from_chars(text.data(), last, back);
    if (double(back * unit.size) == value) break;
  }
  return {text.data(), last};
}

double number_of(std::string_view text, const FileUnit& unit, const std::string& where) {
  long double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw Error(where, "is '" + std::string(text) + "', expected a finite number");
  if (std::abs(value) > unit.most)
    throw Error(where, "is " + std::string(text) + ", beyond " + options_detail::number_text(unit.most) + unit.name);
  return double(value * unit.size);
}

}  // namespace tilth
