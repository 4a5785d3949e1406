#include <fstream>
#include <io/temporary_folder.hpp>
#include <iterator>
#include <run/sample_record.hpp>
#include <sstream>

#include <gtest/gtest.h>

#include <tilth/report/write_run.hpp>

namespace tilth {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RunRecord, WritesTheFilesOfLoopClosureWhereThereWasOne) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_run(folder / "", looped_record()).empty());
  for (const std::string& file : run_files(OutputOptions{}, true)) EXPECT_FALSE(text_of(folder / file).empty()) << file;
  std::istringstream lines(text_of(folder / "closures.csv"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 41) << line;
  EXPECT_EQ(count, 4U);
}

TEST(RunRecord, WritesTheOtherFilesWhereOneFails) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "map.pcd");
  const std::vector<std::string> failures = write_run(folder / "", sample_record());
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_NE(failures[0].find("map.pcd"), std::string::npos);
  for (const char* file : {"trajectory.tum", "trajectory_kitti.txt", "scans.csv", "summary.json"}) {
    EXPECT_FALSE(text_of(folder / file).empty()) << file;
  }
}

}  // namespace
}  // namespace tilth
