// A run whose track was lost ends like no other: said on the console, in its files and by its exit code.
#include <gtest/gtest.h>

#include "program.hpp"

namespace tilth::app {
namespace {

/// Twenty scans of a corridor, of which the last ten come half a minute later.
void write_paused(const std::filesystem::path& folder) {
  ASSERT_EQ(tilth({"simulate", "corridor", "--duration", "2.2", "--out", folder.string()}).exit_code, 0);
  std::istringstream times(text_of(folder / "times.txt"));
  std::ofstream paused(folder / "times.txt");
  std::size_t count = 0;
  for (double time = 0; times >> time; ++count) paused << std::fixed << time + (count < 10 ? 0 : 30) << '\n';
}

TEST(LostTrack, IsSaidEverywhere) {
  const TemporaryFolder folder;
  const std::string scans = folder / "scans", out = folder / "out";
  write_paused(scans);
  const Outcome outcome = tilth({"run", scans, "--out", out});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("the track was lost from "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: the track is found again at "), std::string::npos) << outcome.err;
  EXPECT_NE(text_of(folder / "out" / "summary.json").find("\"lost\": true"), std::string::npos);
  EXPECT_NE(text_of(folder / "out" / "scans.csv").find(",recovered,"), std::string::npos);
  EXPECT_NE(text_of(folder / "out" / "report.html").find("class=\"alarm\""), std::string::npos);
  EXPECT_GT(lines_in(text_of(folder / "out" / "trajectory.tum")), 15U) << "all is written";
}

TEST(LostTrack, IsAnErrorWhereStrict) {
  const TemporaryFolder folder;
  const std::string scans = folder / "scans", out = folder / "out";
  write_paused(scans);
  EXPECT_EQ(tilth({"run", scans, "--out", out, "--strict"}).exit_code, 1);
  EXPECT_FALSE(text_of(folder / "out" / "trajectory.tum").empty());
}

}  // namespace
}  // namespace tilth::app
