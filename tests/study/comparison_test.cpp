// The tables of a comparison against statistics worked out by hand.
#include <fstream>
#include <io/temporary_folder.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/io/output_file.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/study/comparison.hpp>

namespace tilth {
namespace {

RunOutcome run_of(const std::string& method, const std::string& seed, std::vector<double> ape) {
  RunOutcome run;
  run.label = {"corridor", seed, method};
  run.ape = std::move(ape);
  run.cpu_ms = 4;
  run.end_drift = 0.1;
  return run;
}

Comparison sample() {
  Comparison comparison{"1.2", "base", judging_defaults(), {}, {}};
  comparison.runs.push_back(run_of("ours", "1", {0.1, 0.3}));
  comparison.runs.push_back(run_of("base", "1", {1.0, 1.0}));
  comparison.runs.push_back(run_of("ours", "2", {0.2, 0.2, 0.4, 0.6}));
  comparison.runs.back().cpu_ms = 8;
  comparison.runs.back().end_drift = 0.3;
  comparison.runs.push_back(run_of("base", "2", {}));
  comparison.runs.back().failure = "it threw";
  return comparison;
}

TEST(Comparison, PutsAllPosesOfAllRunsTogether) {
  const std::vector<MethodSummary> all = summarize(sample().runs);
  ASSERT_EQ(all.size(), 2U);
  const MethodSummary& ours = all[0];
  EXPECT_EQ(ours.method, "ours");
  EXPECT_EQ(ours.runs, 2U);
  EXPECT_EQ(ours.failed, 0U);
  EXPECT_NEAR(ours.ape.mean, 0.3, 1e-12);     // 1.8 / 6
  EXPECT_NEAR(ours.ape.median, 0.25, 1e-12);  // of 0.1 0.2 0.2 0.3 0.4 0.6
  EXPECT_NEAR(ours.ape.rmse, std::sqrt(0.7 / 6), 1e-12);
  EXPECT_NEAR(ours.ape.std, std::sqrt(0.7 / 6 - 0.09), 1e-12);
  EXPECT_DOUBLE_EQ(ours.ape.min, 0.1);
  EXPECT_DOUBLE_EQ(ours.ape.max, 0.6);
  EXPECT_NEAR(ours.worst_rmse, std::sqrt(0.6 / 4), 1e-12);
  EXPECT_DOUBLE_EQ(ours.mean.cpu_ms, 6);
  EXPECT_DOUBLE_EQ(ours.worst_drift, 0.3);
}

TEST(Comparison, CountsFailedRunsAndNamesThem) {
  const Comparison comparison = sample();
  const std::vector<MethodSummary> all = summarize(comparison.runs);
  EXPECT_EQ(all[1].runs, 2U);
  EXPECT_EQ(all[1].failed, 1U);
  EXPECT_EQ(all[1].judged, 1U);
  const std::string text = table_text(summary_table(comparison));
  EXPECT_NE(text.find("Failed: corridor, seed 2, base: it threw (no figures)."), std::string::npos) << text;
}

TEST(Comparison, TellsWhatItsFiguresMeanBeforeThem) {
  const Report report = report_of(sample());
  ASSERT_GE(report.notes.size(), 2U);
  EXPECT_NE(report.notes.front().find("APE of the translation"), std::string::npos) << report.notes.front();
  const auto failure = [](const std::string& note) {
    return note.starts_with("Failed: corridor, seed 2, base: it threw");
  };
  EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(), failure)) << "a sentence of its own";
}

TEST(Comparison, SaysHowMuchLessThanTheBase) {
  EXPECT_DOUBLE_EQ(improvement(0.3, 1.0), 70);
  EXPECT_DOUBLE_EQ(improvement(1.5, 1.0), -50);
  const FigureTable table = summary_table(sample());
  std::size_t column = 0;
  while (table.columns[column].key != "mean_below_base_percent") ++column;
  EXPECT_NEAR(*table.rows[0][column].number, 70, 1e-9);
  EXPECT_NEAR(*table.rows[1][column].number, 0, 1e-9);
}

TEST(Comparison, WritesTheSameFiguresEverywhere) {
  const TemporaryFolder folder;
  write_comparison(folder / "", sample());
  std::ifstream json_file(folder / "comparison.json"), csv(folder / "comparison.csv"), md(folder / "comparison.md");
  const auto json = nlohmann::json::parse(json_file);
  ASSERT_EQ(json["summary"]["rows"].size(), 2U);
  EXPECT_EQ(json["runs"]["rows"].size(), 4U);
  std::string header, line;
  std::getline(csv, header);
  std::getline(csv, line);
  for (const char* key : {"ape_mean_m", "ape_rmse_m", "ape_median_m"}) {
    const std::string figure = json["summary"]["rows"][0][key].dump();
    EXPECT_NE(("," + line + ",").find("," + figure + ","), std::string::npos) << key << " " << figure << " in " << line;
  }
  const std::string markdown{std::istreambuf_iterator<char>(md), {}};
  EXPECT_NE(markdown.find("| corridor | ours | 2 | 0 | 0.6000 | 0.3000 | 0.2500 | 0.1000 |"), std::string::npos)
      << markdown;
}

class JudgeRun : public testing::Test {
 protected:
  JudgeRun() {
    for (int i = 0; i < 40; ++i) {
      const double s = 0.1 * i;
      Pose pose = Pose::Identity();
      pose.translation() = Eigen::Vector3d(s, 0.3 * std::sin(s), 0.1 * std::cos(2 * s));
      truth_.push_back({s, pose});
    }
    write_tum(folder_ / "truth.tum", truth_);
    write_tum(folder_ / "trajectory.tum", truth_);
    write_summary("end of input", 0);
  }

  void write_summary(const std::string& ended, int skipped) {
    nlohmann::json json{{"ended", ended}, {"counts", {{"skipped", skipped}}}, {"peak_megabytes", 12.0}};
    json["milliseconds"]["register_cpu"] = {{"mean", 3.0}, {"p99", 5.0}};
    write_text(folder_ / "summary.json", json.dump());
  }

  RunOutcome judge(std::size_t expected = 40, const std::string& failure = "") {
    return judge_run({folder_ / "", folder_ / "truth.tum", expected}, {"room", "", "ours"}, judging_defaults(),
                     failure);
  }

  TemporaryFolder folder_;
  Trajectory truth_;
};

TEST_F(JudgeRun, FindsNoFaultWithTheTruth) {
  const RunOutcome run = judge();
  EXPECT_EQ(run.failure, "");
  EXPECT_EQ(run.scans, 40U);
  EXPECT_NEAR(metric_of(run.ape).max, 0, 1e-9);
  EXPECT_NEAR(run.end_drift, 0, 1e-6);
  EXPECT_DOUBLE_EQ(run.cpu_ms, 3);
  EXPECT_FALSE(run.consistency);
}

TEST_F(JudgeRun, MeasuresWhereTheEndLies) {
  Trajectory drifting = truth_;
  drifting.back().T_world_lidar.translation().z() += 0.05;
  write_tum(folder_ / "trajectory.tum", drifting);
  const RunOutcome run = judge();
  EXPECT_NEAR(run.end_drift, 100 * 0.05 / path_length(truth_), 1e-6);
}

TEST_F(JudgeRun, TakesLostScansForAFailure) {
  EXPECT_EQ(judge(42).failure, "2 scans lost");
  write_summary("end of input", 3);
  EXPECT_EQ(judge(0).failure, "3 scans lost");
}

TEST_F(JudgeRun, TakesALargeErrorForAFailureAndKeepsIt) {
  Trajectory lost = truth_;
  for (std::size_t i = 20; i < lost.size(); ++i) lost[i].T_world_lidar.translation() *= 10;
  write_tum(folder_ / "trajectory.tum", lost);
  const RunOutcome run = judge();
  EXPECT_TRUE(run.failure.starts_with("APE RMSE ")) << run.failure;
  EXPECT_EQ(run.ape.size(), 40U);
}

TEST_F(JudgeRun, KeepsTheFirstReason) {
  write_summary("the input breaks off", 0);
  EXPECT_EQ(judge().failure, "ended early: the input breaks off");
  EXPECT_EQ(judge(40, "it crashed").failure, "it crashed");
}

TEST_F(JudgeRun, TakesMissingFilesForAFailure) {
  std::filesystem::remove(folder_ / "trajectory.tum");
  const RunOutcome run = judge();
  EXPECT_NE(run.failure.find("trajectory.tum"), std::string::npos) << run.failure;
  EXPECT_TRUE(run.ape.empty());
}

TEST_F(JudgeRun, ReadsTheVariancesOfThePoses) {
  std::string csv = "stamp,var_rx,var_ry,var_rz,var_tx,var_ty,var_tz\n";
  for (const StampedPose& pose : truth_) csv += std::to_string(pose.stamp) + ",1,1,1,1,1,1\n";
  write_text(folder_ / "scans.csv", csv);
  const RunOutcome run = judge();
  ASSERT_TRUE(run.consistency);
  EXPECT_EQ(run.consistency->poses, 40U);
  EXPECT_NEAR(run.consistency->mean_nees, 0, 1e-9);
}

}  // namespace
}  // namespace tilth
