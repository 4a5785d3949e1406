#include <fstream>
#include <io/temporary_folder.hpp>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/output/output_folder.hpp>
#include <tilth/output/summary_json.hpp>

namespace tilth {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Four scans, 1 m and 0.5 s apart, back at the start with the last; 100, 200, 300 and 400 ms.
RunRecord sample_record() {
  RunRecord record;
  record.pipeline = "sample";
  record.options = {{"a.b", "3", "m", "meaning", "0 .. 9"}};
  record.skipped = {{7, "scan7.pcd", "is \"empty\""}};
  record.scans.stages = {"first", "second"};
  const double x[] = {0, 1, 1, 0}, y[] = {0, 0, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    record.trajectory.push_back({0.5 * double(i), Pose(Eigen::Translation3d(x[i], y[i], 0))});
    ScanRow row;
    row.stamp = 0.5 * double(i);
    row.register_ms = 100.0 * double(i + 1);
    row.converged = i != 2;
    row.stage_ms.assign(i == 0 ? 1 : 2, 7.0);
    record.scans.rows.push_back(row);
  }
  return record;
}

TEST(Distribution, InterpolatesBetweenRanks) {
  const Distribution d = distribution_of({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(d.mean, 2.5);
  EXPECT_DOUBLE_EQ(d.median, 2.5);
  EXPECT_DOUBLE_EQ(d.p99, 3.97);
  EXPECT_DOUBLE_EQ(d.max, 4);
  EXPECT_EQ(distribution_of({}).max, 0.0);
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

RunRecord looped_record() {
  RunRecord record = sample_record();
  LoopRecord loops{.odometry = record.trajectory};
  loops.graph.poses.assign(3, Pose::Identity());
  for (const char* verdict : {"accepted", "ambiguous", "accepted"}) {
    ClosureRow row;
    row.verdict = verdict;
    loops.closures.push_back(row);
  }
  record.loops = loops;
  return record;
}

TEST(Summary, TellsOfLoopClosure) {
  EXPECT_FALSE(nlohmann::json::parse(summary_json(sample_record())).contains("loop_closure"));
  const nlohmann::json loops = nlohmann::json::parse(summary_json(looped_record()))["loop_closure"];
  EXPECT_EQ(loops["keyframes"], 3);
  EXPECT_EQ(loops["candidates"], 3);
  EXPECT_EQ(loops["accepted"], 2);
  EXPECT_EQ(loops["verdicts"]["ambiguous"], 1);
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

TEST(ScanTable, HasOneCellAColumn) {
  const TemporaryFolder folder;
  write_scan_table(folder / "scans.csv", sample_record().scans);
  std::istringstream lines(text_of(folder / "scans.csv"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 24) << line;
  }
  EXPECT_EQ(count, 5U);
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

}  // namespace
}  // namespace tilth
