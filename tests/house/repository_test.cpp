// What is committed: sources, documents and small pictures, no outputs of runs.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tilth {
namespace {

const std::filesystem::path kRoot = TILTH_SOURCE_DIR;

/// The files that git keeps; none where this is no checkout, or git is missing.
std::vector<std::string> committed_files() {
  const std::string command = "git -C '" + kRoot.string() + "' ls-files 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::vector<std::string> files;
  std::array<char, 4096> line{};
  while (pipe && std::fgets(line.data(), int(line.size()), pipe.get())) {
    files.emplace_back(line.data());
    files.back().pop_back();  // the newline
  }
  return files;
}

TEST(Repository, KeepsNoOutputsOfRuns) {
  const std::vector<std::string> files = committed_files();
  if (files.empty()) GTEST_SKIP() << kRoot << " is no checkout of git";
  constexpr std::uintmax_t kMost = 2'000'000;  // [bytes]
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    for (const char* output : {"summary.json", "report.html", "scans.csv", "map.pcd", "trajectory.tum"})
      EXPECT_NE(path.filename(), output) << file;
    std::error_code gone;
    const std::uintmax_t bytes = std::filesystem::file_size(kRoot / path, gone);
    if (!gone) {
      EXPECT_LT(bytes, kMost) << file;
    }
  }
}

}  // namespace
}  // namespace tilth
