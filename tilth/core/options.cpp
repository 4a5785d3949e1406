#include <array>
#include <cmath>

#include <tilth/core/options.hpp>

namespace tilth::options_detail {

std::string number_text(double value) {
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

void refuse(const std::string& key, const std::string& text, const std::string& expected) {
  throw Error("option " + key, "is '" + text + "', expected " + expected);
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : " | ") + std::string(name);
  return text;
}

}  // namespace tilth::options_detail
