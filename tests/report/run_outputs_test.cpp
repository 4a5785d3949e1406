#include <fstream>
#include <io/temporary_folder.hpp>
#include <iterator>
#include <run/sample_record.hpp>
#include <run/scan_list.hpp>
#include <sstream>

#include <gtest/gtest.h>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/plot/svg_plot.hpp>
#include <tilth/report/html_report.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/report/run_report.hpp>
#include <tilth/run/session.hpp>

namespace tilth {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

OutputOptions everything() {
  return {.map_format = "pcd,ply,las,bt,tiles", .mcap = true, .grid = true};
}

/// A session over no scans whose record is `record`, with every file of `outputs` in `folder`.
std::vector<std::string> written(const TemporaryFolder& folder, const std::vector<RunOutput>& outputs,
                                 RunRecord record) {
  Session session(std::make_unique<ScanList>(), {make_odometry("floam", {})}, std::move(record));
  for (const RunOutput& output : outputs) session.add(output.open(folder / output.file));
  return session.finish();
}

TEST(RunOutputs, AreWrittenUnderTheirNames) {
  const TemporaryFolder folder;
  const std::vector<RunOutput> outputs = run_outputs(everything(), {}, true);
  EXPECT_EQ(written(folder, outputs, looped_record()), std::vector<std::string>{});
  for (const RunOutput& output : outputs) EXPECT_FALSE(text_of(folder / output.file).empty()) << output.file;
  std::istringstream lines(text_of(folder / "closures.csv"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 41) << line;
  EXPECT_EQ(count, 4U);
}

TEST(RunOutputs, OneThatFailsDoesNotKeepTheOthersFromBeingWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "map.pcd");
  const std::vector<std::string> failures = written(folder, run_outputs({}, {}, false), sample_record());
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_NE(failures[0].find("map.pcd"), std::string::npos);
  for (const char* file : {"trajectory.tum", "trajectory_kitti.txt", "scans.csv", "summary.json", "report.html"}) {
    EXPECT_FALSE(text_of(folder / file).empty()) << file;
  }
}

TEST(RunOutputs, OfLoopClosureAreRefusedWithoutIt) {
  const TemporaryFolder folder;
  const std::vector<std::string> failures = written(folder, run_outputs({}, {}, true), sample_record());
  ASSERT_EQ(failures.size(), 3U);
  for (const std::string& failure : failures) EXPECT_NE(failure.find("no loop closure"), std::string::npos) << failure;
}

TEST(RunReport, BeginsWithATrackThatWasLost) {
  EXPECT_EQ(report_of(sample_record(), 0).alarm, "");
  EXPECT_NE(report_of(lost_record(), 0).alarm.find("lost from 1.000 s"), std::string::npos);
  EXPECT_NE(html_report(report_of(lost_record(), 0)).find("class=\"alarm\""), std::string::npos);
  EXPECT_EQ(html_report(report_of(sample_record(), 0)).find("class=\"alarm\""), std::string::npos);
}

TEST(RunReport, EveryCurveOverTimeShowsWhereTheTrackWasLost) {
  std::size_t over_time = 0;
  for (const Section& section : report_of(lost_record(), 0).sections) {
    for (const Plot& plot : section.plots) {
      EXPECT_EQ(plot.alarm.has_value(), plot.over_time) << plot.id;
      if (!plot.alarm) continue;
      ++over_time;
      EXPECT_EQ(plot.alarm->spans, (std::vector{std::pair(1.0, 1.5)})) << plot.id;
      EXPECT_NE(svg_file(plot).find("class=\"alarm\""), std::string::npos) << plot.id;
    }
  }
  EXPECT_GT(over_time, 8U);
  for (const Section& section : report_of(sample_record(), 0).sections) {
    for (const Plot& plot : section.plots) EXPECT_FALSE(plot.alarm) << plot.id;
  }
}

}  // namespace
}  // namespace tilth
