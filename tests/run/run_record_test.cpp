#include <fstream>
#include <io/temporary_folder.hpp>
#include <iterator>
#include <run/sample_record.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/run/output_folder.hpp>
#include <tilth/run/output_options.hpp>
#include <tilth/run/summary_json.hpp>

namespace tilth {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RunFigures, MeasureTheTrajectoryAndTheClock) {
  const RunFigures figures = figures_of(sample_record());
  EXPECT_DOUBLE_EQ(figures.recorded_seconds, 2.0);
  EXPECT_DOUBLE_EQ(figures.registering_seconds, 1.0);
  EXPECT_DOUBLE_EQ(figures.real_time_factor, 2.0);
  EXPECT_DOUBLE_EQ(figures.distance, 2.0 + std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(figures.end_to_start, 0.0);
}

TEST(RunFigures, AreZeroWithoutScans) {
  EXPECT_EQ(figures_of(RunRecord{}).real_time_factor, 0.0);
  EXPECT_NO_THROW(nlohmann::json::parse(summary_json(RunRecord{})));
}

TEST(Summary, SaysWhatTheRunWas) {
  const nlohmann::json summary = nlohmann::json::parse(summary_json(sample_record()));
  EXPECT_EQ(summary["options"]["a.b"], "3");
  EXPECT_EQ(summary["skipped"][0]["what"], "is \"empty\"");
  EXPECT_EQ(summary["counts"]["scans"], 4);
  EXPECT_EQ(summary["counts"]["not_converged"], 1);
  EXPECT_EQ(summary["milliseconds"]["register"]["max"], 400.0);
  EXPECT_EQ(summary["milliseconds"]["stages"]["second"]["mean"], 5.25);
  EXPECT_FALSE(summary.contains("evaluation"));
}

TEST(Summary, TellsOfLoopClosure) {
  EXPECT_FALSE(nlohmann::json::parse(summary_json(sample_record())).contains("loop_closure"));
  const nlohmann::json loops = nlohmann::json::parse(summary_json(looped_record()))["loop_closure"];
  EXPECT_EQ(loops["keyframes"], 3);
  EXPECT_EQ(loops["candidates"], 3);
  EXPECT_EQ(loops["accepted"], 2);
  EXPECT_EQ(loops["verdicts"]["ambiguous"], 1);
}

TEST(ScanTable, HasOneCellAColumn) {
  const TemporaryFolder folder;
  write_scan_table(folder / "scans.csv", sample_record().scans);
  std::istringstream lines(text_of(folder / "scans.csv"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 26) << line;
  }
  EXPECT_EQ(count, 5U);
}

TEST(OutputFolder, IsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  const std::vector<std::string> files{"a", "b"};
  prepare_output_folder(folder / "new", files);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "new"));
  std::filesystem::create_directory(folder / "new" / "b");
  EXPECT_THROW(prepare_output_folder(folder / "new", files), Error);
  std::ofstream(folder / "file") << "mine";
  EXPECT_THROW(prepare_output_folder(folder / "file", files), Error);
  EXPECT_EQ(text_of(folder / "file"), "mine");
}

TEST(OutputOptions, AnOriginThatNoFileHasIsRefused) {
  EXPECT_FALSE(origin_of({}));
  EXPECT_TRUE(origin_of({.map_format = "pcd,las", .origin = "32N,1,2,3"}));
  EXPECT_THROW(origin_of({.origin = "32N,1,2,3"}), Error);
}

}  // namespace
}  // namespace tilth
