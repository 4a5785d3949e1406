// Which options are whole numbers: OptionInfo has values as text, and does not tell.
#pragma once

#include <concepts>
#include <set>
#include <string>
#include <string_view>

#include <tilth/core/options.hpp>

namespace tilth {
namespace options_detail {

struct WholeNumbers {
  std::set<std::string>& keys;
  std::string prefix;

  template <class T>
  void operator()(std::string_view name, T&, Bounds, std::string_view, Audience = {}) const {
    if constexpr (std::integral<T> && !std::same_as<T, bool>) keys.insert(prefix + std::string(name));
  }
  template <class T>
  void operator()(std::string_view name, T& field, std::string_view meaning, Audience = {}) const {
    if constexpr (Options<T>)
      visit(field, WholeNumbers{keys, prefix + std::string(name) + "."});
    else
      (*this)(name, field, Bounds{}, meaning);
  }
};

}  // namespace options_detail

/// The keys of those options that are numbers without fraction.
template <Options O>
std::set<std::string> whole_numbers(O options = {}) {
  std::set<std::string> keys;
  visit(options, options_detail::WholeNumbers{keys, ""});
  return keys;
}

}  // namespace tilth
