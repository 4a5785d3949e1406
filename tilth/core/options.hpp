// Options named once. A stage's options are a struct with defaults and one function
//
//   template <class V> void visit(SorOptions& o, V&& v) {
//     v("k", o.k, Bounds{3, 64}, "[points] neighbours of each point");
//     v("method", o.method, "[-] ...");  // an enum with `names_of(Method)`; bool, std::string and nested options alike
//   }
//
// from which YAML, the command line, `tilth config` and the documents all read. A meaning begins with its [unit];
// behind it kAdvanced marks what users need not know, of nested options all of them.
#pragma once

#include <algorithm>
#include <charconv>
#include <concepts>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tilth/core/error.hpp>

namespace tilth {

/// Flat option values: "align.max_iterations" -> "12".
using OptionValues = std::map<std::string, std::string>;

/// Inclusive bounds of a number.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Who has to know an option: lists show those of experiments last.
enum class Audience { users, experiments };
inline constexpr Audience kAdvanced = Audience::experiments;

/// One option as documents and `tilth config` show it.
struct OptionInfo {
  std::string key, value, unit, meaning;
  std::string allowed;    ///< "3 .. 64", "true | false" or the names of an enum
  bool advanced = false;  ///< kAdvanced
  bool whole = false;     ///< a number without fraction
};

namespace options_detail {

struct AnyVisitor {
  void operator()(std::string_view, auto&, std::string_view, Audience = {}) const {}
  void operator()(std::string_view, auto&, Bounds, std::string_view, Audience = {}) const {}
};

std::string number_text(double value);  // shortest text that reads back equal
[[noreturn]] void refuse(const std::string& key, const std::string& text, const std::string& expected);
std::string joined(std::span<const std::string_view> names);

}  // namespace options_detail

template <class T>
concept Options = requires(T& o) {
  visit(o, options_detail::AnyVisitor{});
};

template <class T>
concept NamedEnum = std::is_enum_v<T> && requires(T e) {
  { names_of(e) } -> std::convertible_to<std::span<const std::string_view>>;
};

namespace options_detail {

template <class T>
std::string to_text(const T& field) {
  if constexpr (std::same_as<T, bool>)
    return field ? "true" : "false";
  else if constexpr (std::same_as<T, std::string>)
    return field;
  else if constexpr (NamedEnum<T>)
    return std::string(std::span<const std::string_view>(names_of(field))[std::size_t(field)]);
  else
    return number_text(double(field));
}

template <class T>
std::string allowed(Bounds bounds) {
  if constexpr (std::same_as<T, bool>)
    return "true | false";
  else if constexpr (std::same_as<T, std::string>)
    return "text";
  else if constexpr (NamedEnum<T>)
    return joined(names_of(T{}));
  else
    return number_text(bounds.min) + " .. " + number_text(bounds.max);
}

template <class T>
void parse_number(const std::string& key, const std::string& text, T& field, Bounds bounds) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    refuse(key, text, std::is_integral_v<T> ? "a whole number" : "a number");
  }
  if (!(double(value) >= bounds.min && double(value) <= bounds.max))
    refuse(key, text, "a value in " + allowed<T>(bounds));
  field = value;
}

template <class T>
void parse(const std::string& key, const std::string& text, T& field, Bounds bounds) {
  if constexpr (std::same_as<T, bool>) {
    if (text != "true" && text != "false") refuse(key, text, "true or false");
    field = text == "true";
  } else if constexpr (std::same_as<T, std::string>) {
    field = text;
  } else if constexpr (NamedEnum<T>) {
    const std::span<const std::string_view> names = names_of(field);
    std::size_t i = 0;
    while (i < names.size() && names[i] != text) ++i;
    if (i == names.size()) refuse(key, text, "one of " + joined(names));
    field = T(i);
  } else {
    parse_number(key, text, field, bounds);
  }
}

/// Reads the values of one struct and takes what it used out of `values`.
struct Reader {
  OptionValues& values;
  std::string prefix;

  template <class T>
  void operator()(std::string_view name, T& field, Bounds bounds, std::string_view, Audience = {}) const {
    const auto it = values.find(prefix + std::string(name));
    if (it == values.end()) return;
    parse(it->first, it->second, field, bounds);
    values.erase(it);
  }
  template <class T>
  void operator()(std::string_view name, T& field, std::string_view meaning, Audience = {}) const {
    if constexpr (Options<T>)
      visit(field, Reader{values, prefix + std::string(name) + "."});
    else
      (*this)(name, field, Bounds{}, meaning);
  }
};

struct Writer {
  std::vector<OptionInfo>& rows;
  std::string prefix;
  Audience audience = {};  ///< of all options

  template <class T>
  void operator()(std::string_view name, T& field, Bounds bounds, std::string_view doc, Audience own = {}) const {
    const std::size_t close = doc.find(']');
    rows.push_back({prefix + std::string(name), to_text(field), std::string(doc.substr(1, close - 1)),
                    std::string(doc.substr(std::min(close + 2, doc.size()))), allowed<T>(bounds),
                    std::max(audience, own) == kAdvanced, std::integral<T> && !std::same_as<T, bool>});
  }
  template <class T>
  void operator()(std::string_view name, T& field, std::string_view doc, Audience own = {}) const {
    if constexpr (Options<T>)
      visit(field, Writer{rows, prefix + std::string(name) + ".", std::max(audience, own)});
    else
      (*this)(name, field, Bounds{}, doc, own);
  }
};

}  // namespace options_detail

/// Every option of `options`, in the order of `visit`.
template <Options O>
std::vector<OptionInfo> describe(O options) {
  std::vector<OptionInfo> rows;
  visit(options, options_detail::Writer{rows, "", Audience::users});
  return rows;
}

/// Throws Error for a key that none of `known` has: what it is called today where it was renamed.
[[noreturn]] void refuse_unknown(const std::string& key, std::span<const OptionInfo> known);

/// `options` with `values` set. Throws Error naming the key that is unknown, is no number, or breaks its bounds.
template <Options O>
O with(OptionValues values, O options = {}) {
  visit(options, options_detail::Reader{values, ""});
  if (!values.empty()) refuse_unknown(values.begin()->first, describe(options));
  return options;
}

}  // namespace tilth
