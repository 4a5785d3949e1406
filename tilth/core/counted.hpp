// Numbers of things in words.
#pragma once

#include <cstddef>
#include <string>

namespace tilth {

/// "1 scan", "12 scans".
inline std::string counted(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

}  // namespace tilth
