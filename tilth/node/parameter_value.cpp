#include <charconv>
#include <cmath>
#include <limits>

#include <tilth/node/parameter_value.hpp>

namespace tilth {
namespace {

constexpr std::string_view kTo = " .. ";  // between the bounds of a number

double parsed(const OptionInfo& option, const std::string& text) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (text == "inf" || text == "-inf") return text == "inf" ? kInfinity : -kInfinity;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) throw Error(option.key, "is no number: " + text);
  return value;
}

}  // namespace

ParameterType type_of(const NodeParameter& parameter) {
  if (parameter.allowed == "true | false") return ParameterType::flag;
  if (parameter.allowed.find(kTo) == std::string::npos) return ParameterType::text;
  return parameter.whole ? ParameterType::integer : ParameterType::number;
}

Bounds bounds_of(const OptionInfo& option) {
  const std::size_t to = option.allowed.find(kTo);
  if (to == std::string::npos) throw Error(option.key, "has no bounds: " + option.allowed);
  return {parsed(option, option.allowed.substr(0, to)), parsed(option, option.allowed.substr(to + kTo.size()))};
}

double number_of(const OptionInfo& option) {
  return parsed(option, option.value);
}

std::string parameter_text(double value) {
  constexpr double kWhole = 9007199254740992.0;  // 2^53
  if (std::abs(value) < kWhole && value == std::floor(value)) return std::to_string(std::int64_t(value));
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace tilth
