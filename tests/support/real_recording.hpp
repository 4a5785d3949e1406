// Where real recordings are, for tests that are skipped without them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tilth {

inline std::filesystem::path recording(const std::string& name) {
  const char* data = std::getenv("TILTH_DATA");
  return (data != nullptr ? std::filesystem::path(data) : std::filesystem::path(TILTH_SOURCE_DIR) / "../shared/data") /
         name;
}

#define NEEDS(folder) \
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording " << folder << " (set TILTH_DATA)"

}  // namespace tilth
