// The tables and pictures of a parameter study.
#include <io/temporary_folder.hpp>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/study/sweep.hpp>

namespace tilth {
namespace {

SweepRun run_of(const std::string& k, const std::string& alpha, double error) {
  SweepRun run;
  run.values = {k, alpha};
  run.outcome.label = {"plaza", "1", "p:k=" + k + ":alpha=" + alpha};
  run.outcome.ape = {error, error};
  run.figures = {{"removed_percent", 10 * error}};
  return run;
}

Sweep sample() {
  Sweep sweep{"1.2", "p", {"k", "alpha"}, {"10", "7"}, true, judging_defaults(), {}};
  for (const char* k : {"5", "10"}) {
    for (const char* alpha : {"0.5", "1"}) sweep.runs.push_back(run_of(k, alpha, std::stod(k) * std::stod(alpha)));
  }
  return sweep;
}

TEST(Sweep, HasARowForEachSetting) {
  const FigureTable table = sweep_table(sample());
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(table.columns[1].key, "k");
  EXPECT_EQ(table.rows[1][1].word, "5");
  EXPECT_EQ(table.rows[1][2].word, "1");
  EXPECT_DOUBLE_EQ(*table.rows[1][5].number, 5.0);
}

TEST(Sweep, AveragesFiguresOverTheRunsOfASetting) {
  Sweep sweep = sample();
  sweep.runs.push_back(run_of("5", "0.5", 4.5));
  sweep.runs.back().outcome.label.seed = "2";
  const FigureTable table = sweep_table(sweep);
  ASSERT_EQ(table.rows.size(), 4U);
  std::size_t column = 0;
  while (table.columns[column].key != "removed_percent") ++column;
  EXPECT_DOUBLE_EQ(*table.rows[0][column].number, (25 + 45) / 2.0);
  EXPECT_FALSE(table.rows[0][column + 1].number);
}

TEST(Sweep, DrawsAMapForEachFigureThatIsKnown) {
  const TemporaryFolder folder;
  write_sweep(folder / "", sample());
  EXPECT_TRUE(std::filesystem::exists(folder / "plots/heat_1_ape_rmse_m.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder / "plots/heat_1_removed_percent.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder / "plots/heat_1_edges.svg"));
}

TEST(Sweep, ReportsEachParameterAloneAndAsAGrid) {
  Sweep sweep = sample();
  const Report report = report_of(sweep);
  ASSERT_EQ(report.sections.size(), 3U) << "k, alpha, plaza";
  const Plot& over_alpha = report.sections[1].plots.front();
  EXPECT_EQ(report.sections[1].note, "k = 10 ") << "as where the sweep changes nothing";
  EXPECT_EQ(over_alpha.curves[0].x, (std::vector<float>{0.5F, 1}));
  EXPECT_EQ(over_alpha.curves[0].y, (std::vector<float>{5, 10}));
  EXPECT_EQ(report.sections[0].note, "alpha = 0.5 ") << "7 was not run";
  const Plot& heat = report.sections[2].plots.front();
  EXPECT_EQ(heat.kind, PlotKind::heat);
  EXPECT_EQ(heat.categories, (std::vector<std::string>{"5", "10"}));
  EXPECT_EQ(heat.curves[1].name, "1");
  EXPECT_EQ(heat.curves[1].y, (std::vector<float>{5, 10}));
  EXPECT_EQ(report.sections[2].tables.front().rows.size(), 4U);
  sweep.grid = false;
  EXPECT_TRUE(report_of(sweep).sections[2].plots.empty());
}

TEST(Sweep, DrawsAParameterOfWordsAsBars) {
  Sweep sweep = sample();
  for (SweepRun& run : sweep.runs) run.values[1] = run.values[1] == "1" ? "weighted" : "plain";
  const Plot plot = report_of(sweep).sections[1].plots.front();
  EXPECT_EQ(plot.kind, PlotKind::bars);
  EXPECT_EQ(plot.categories, (std::vector<std::string>{"plain", "weighted"}));
}

TEST(Sweep, ReadsWhatScansAndScoreTell) {
  const TemporaryFolder folder;
  EXPECT_TRUE(study_figures(folder / "").empty());
  write_text(folder / "scans.csv", "points_in,outliers,edges,planes,ms_outliers\n100,4,10,20,1.5\n100,6,20,40,2.5\n");
  write_text(folder / "score.json", R"([{"removed_obvious":0.9,"kept_edges":0.8,"kept_surface":0.7,"accuracy":0.6,)"
                                    R"("pseudo_feature_reduction":0.5,"false_edge_ratio_after":0.04}])");
  const StudyFigures figures = study_figures(folder / "");
  EXPECT_DOUBLE_EQ(figures.at("removed_percent"), 5);
  EXPECT_DOUBLE_EQ(figures.at("edges"), 15);
  EXPECT_DOUBLE_EQ(figures.at("outliers_ms"), 2);
  EXPECT_DOUBLE_EQ(figures.at("removed_obvious_percent"), 90);
  EXPECT_DOUBLE_EQ(figures.at("pseudo_ratio_percent"), 4);
  write_text(folder / "score.json", "[{}]");
  EXPECT_THROW(study_figures(folder / ""), Error);
}

}  // namespace
}  // namespace tilth
