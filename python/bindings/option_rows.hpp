// Options as Python lists them.
#pragma once

#include <string>
#include <vector>

#include <tilth/core/options.hpp>

namespace tilth::python {

/// Of each option: key, value, unit, what is allowed, meaning.
inline std::vector<std::vector<std::string>> option_rows(const std::vector<OptionInfo>& options) {
  std::vector<std::vector<std::string>> rows;
  for (const OptionInfo& o : options) rows.push_back({o.key, o.value, o.unit, o.allowed, o.meaning});
  return rows;
}

}  // namespace tilth::python
