#include "number_list.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <tilth/core/error.hpp>

namespace tilth::app {
namespace {

constexpr std::uint64_t kMostNumbers = 10000;

std::optional<std::uint64_t> to_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::vector<std::string> parse_word_list(const std::string& argument, const std::string& text) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    list.push_back(text.substr(begin, end - begin));
    if (list.back().empty()) throw Error(argument + " " + text, "has an empty part; expected a,b,c");
    begin = end + 1;
  }
  return list;
}

std::vector<std::uint64_t> parse_number_list(const std::string& argument, const std::string& text) {
  std::vector<std::uint64_t> numbers;
  for (const std::string& part : parse_word_list(argument, text)) {
    const std::size_t dash = part.find('-');
    const auto first = to_number(part.substr(0, dash));
    const auto last = dash == std::string::npos ? first : to_number(part.substr(dash + 1));
    if (!first || !last) throw Error(argument + " " + text, "\"" + part + "\" is no number and no range like 1-5");
    if (*last < *first) throw Error(argument + " " + text, "\"" + part + "\" falls; expected the smaller number first");
    if (*last - *first >= kMostNumbers - numbers.size())
      throw Error(argument + " " + text, "is more than 10000 numbers");
    for (std::uint64_t number = *first; number <= *last; ++number) {
      if (std::find(numbers.begin(), numbers.end(), number) == numbers.end()) numbers.push_back(number);
    }
  }
  return numbers;
}

}  // namespace tilth::app
