// A source with options: WHAT?key=value&key=value.
#pragma once

#include <string>

#include <tilth/core/options.hpp>

namespace tilth {

struct SourceUri {
  std::string what;
  OptionValues values;
};

/// Throws Error where a part after the question mark is no key=value.
SourceUri parse_source_uri(const std::string& uri);

}  // namespace tilth
