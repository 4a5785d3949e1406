// A source with options: WHAT?key=value&key=value.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <tilth/core/options.hpp>

namespace tilth {

struct SourceUri {
  std::string what;
  OptionValues values;
};

/// Throws Error where a part after the question mark is no key=value.
SourceUri parse_source_uri(const std::string& uri);

/// The same of a file or folder, in whose name a question mark may stand.
SourceUri parse_path_uri(const std::string& uri);

/// `values` as the options of `what`. Throws Error naming a key that means nothing there.
template <Options O>
O options_of(const std::string& what, const OptionValues& values) {
  const std::vector<OptionInfo> known = describe(O{});
  for (const auto& [key, value] : values) {
    const auto is_it = [&key = key](const OptionInfo& option) { return option.key == key; };
    if (std::none_of(known.begin(), known.end(), is_it)) throw Error("option " + key, "means nothing for " + what);
  }
  return with<O>(values);
}

}  // namespace tilth
