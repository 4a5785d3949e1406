// tilth compare, sweep and job as their users run them: tables, resuming, failures, bad arguments.
#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include <tilth/io/output_file.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kTiny = "sim://corridor?columns=400&duration=1.6";

class Compare : public testing::Test {
 protected:
  std::vector<std::string> arguments(const std::string& command, std::vector<std::string> more) const {
    std::vector<std::string> all{command, "--out", out_.string(), "--align", "origin"};  // it rests
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome compare(std::vector<std::string> more) const { return tilth(arguments("compare", std::move(more))); }
  Json table(const std::string& file = "comparison.json") const { return Json::parse(text_of(out_ / file)); }
  fs::path run_folder(const std::string& seed, const std::string& method) const {
    return out_ / "runs" / ("corridor:columns=400,duration=1.6-" + seed) / method;
  }

  TemporaryFolder folder_;
  fs::path out_ = folder_ / "out";
};

TEST_F(Compare, JudgesEveryPipelineOnEverySeed) {
  const Outcome outcome = compare({"--sources", kTiny, "--seeds", "1-2", "--pipelines", "tilth,improved_floam"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("4 of 4: "), std::string::npos) << outcome.out;
  const Json json = table();
  ASSERT_EQ(json["summary"]["rows"].size(), 2U);
  ASSERT_EQ(json["runs"]["rows"].size(), 4U);
  for (const Json& run : json["runs"]["rows"]) {
    EXPECT_EQ(run["failure"], "");
    EXPECT_GE(run["scans"], 14);
    EXPECT_LT(run["ape_rmse_m"], 0.1);
    EXPECT_GT(run["cpu_ms_mean"], 0.0);
  }
  EXPECT_EQ(json["summary"]["rows"][1]["method"], "improved_floam");
  EXPECT_EQ(json["summary"]["rows"][1]["mean_below_base_percent"], 0.0);
  for (const char* file : {"comparison.txt", "comparison.md", "comparison.csv", "runs.csv"})
    EXPECT_TRUE(fs::exists(out_ / file)) << file;
  EXPECT_TRUE(fs::exists(run_folder("2", "tilth") / "map.pcd"));
  EXPECT_TRUE(fs::exists(out_ / "recordings/corridor:columns=400,duration=1.6-2/truth.tum"));
  EXPECT_FALSE(fs::exists(out_ / "recordings/corridor:columns=400,duration=1.6-2/scans"));
}

TEST_F(Compare, DoesNotRepeatWhatIsFinished) {
  const std::vector<std::string> wanted{"--source", kTiny, "--pipelines", "tilth"};
  ASSERT_EQ(compare(wanted).exit_code, 0);
  const auto before = fs::last_write_time(run_folder("1", "tilth") / "trajectory.tum");
  ASSERT_EQ(compare(wanted).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(run_folder("1", "tilth") / "trajectory.tum"), before);
  EXPECT_EQ(compare({"--source", kTiny, "--pipelines", "tilth", "--list-jobs"}).out, "");
  ASSERT_EQ(compare({"--source", kTiny, "--pipelines", "tilth", "--set", "max_range=60"}).exit_code, 0);
  EXPECT_NE(fs::last_write_time(run_folder("1", "tilth") / "trajectory.tum"), before);
}

TEST_F(Compare, GoesOnAfterItWasKilled) {
  const std::vector<std::string> wanted{"--source", kTiny, "--seeds", "1-3", "--pipelines", "tilth", "--jobs", "1"};
  const Program program(arguments("compare", wanted));
  const fs::path first = run_folder("1", "tilth") / "done.json";
  for (int i = 0; i < 3000 && !fs::exists(first) && program.running(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(SIGKILL);
  EXPECT_EQ(program.wait().exit_code, 128 + SIGKILL);
  ASSERT_TRUE(fs::exists(first));
  const auto before = fs::last_write_time(first);
  const Outcome outcome = compare(wanted);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(fs::last_write_time(first), before);
  EXPECT_EQ(table()["summary"]["rows"][0]["runs"], 3);
  EXPECT_EQ(table()["summary"]["rows"][0]["failed"], 0);
}

TEST_F(Compare, CountsRunsThatFail) {
  const fs::path recording = folder_ / "recording";
  ASSERT_EQ(
      tilth({"simulate", "corridor", "--out", recording.string(), "--set", "columns=400", "duration=1.6", "--quiet"})
          .exit_code,
      0);
  write_text(recording / "scans" / "000003.pcd", "no scan");
  const Outcome outcome = compare({"--sources", recording.string(), "--pipelines", "tilth"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(table()["summary"]["rows"][0]["failed"], 1);
  EXPECT_EQ(table()["runs"]["rows"][0]["failure"], "1 scans lost");
  EXPECT_NE(outcome.out.find("Failed: recording, tilth: 1 scans lost"), std::string::npos) << outcome.out;
  EXPECT_EQ(compare({"--sources", recording.string(), "--pipelines", "tilth", "--max-ape", "1e-9"}).exit_code, 0);
}

TEST_F(Compare, ListsJobsThatAnyEngineCanDo) {
  const Outcome listed = compare({"--source", kTiny, "--pipelines", "tilth:max_range=50", "--list-jobs"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const fs::path folder = run_folder("1", "tilth:max_range=50");
  EXPECT_NE(listed.out.find(" job '" + folder.string() + "'\n"), std::string::npos) << listed.out;
  ASSERT_EQ(tilth({"job", folder.string()}).exit_code, 0);
  EXPECT_NE(text_of(folder / "summary.json").find("\"max_range\": \"50\""), std::string::npos);
  EXPECT_EQ(compare({"--source", kTiny, "--pipelines", "tilth:max_range=50", "--list-jobs"}).out, "");
}

TEST_F(Compare, SweepsEachParameterAloneAndAsAGrid) {
  const std::vector<std::string> wanted{"--source",         kTiny,           "--param", "outliers.k=8,12", "--param",
                                        "outliers.alpha=2", "--score-every", "6"};
  const Outcome alone = tilth(arguments("sweep", wanted));
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(table("sweep.json")["sweep"]["rows"].size(), 4U);  // the defaults, then each value
  std::vector<std::string> grid = wanted;
  grid.push_back("--grid");
  const Outcome outcome = tilth(arguments("sweep", grid));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json rows = table("sweep.json")["sweep"]["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1]["outliers.k"], "12");
  EXPECT_EQ(rows[1]["outliers.alpha"], "2");
  EXPECT_GT(rows[1]["removed_percent"], 0.0);
  EXPECT_GT(rows[1]["kept_surface_percent"], 50.0);
  EXPECT_TRUE(fs::exists(out_ / "plots/heat_1_ape_rmse_m.svg"));
  EXPECT_TRUE(fs::exists(out_ / "report.html"));
}

TEST_F(Compare, NamesTheArgumentThatIsWrong) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--sources", kTiny, "--seeds", "5-1"}, "--seeds 5-1: \"5-1\" falls"},
      {{"--sources", kTiny, "--seeds", "1,,2"}, "--seeds 1,,2: has an empty part"},
      {{"--sources", kTiny, "--seeds", "x"}, "\"x\" is no number"},
      {{"--sources", kTiny, "--seeds", "1-99999999"}, "is more than 10000 numbers"},
      {{"--sources", "sim://nowhere"}, "--sources sim://nowhere: is no scene"},
      {{"--sources", "sim://corridor?speed=x"}, "speed"},
      {{"--sources", (folder_ / "missing").string()}, "is no file"},
      {{"--sources", kTiny + "," + kTiny}, "twice"},
      {{"--sources", (folder_ / ".").string()}, "has no truth beside it"},
      {{"--sources", kTiny, "--pipelines", "no_such"}, "no_such"},
      {{"--sources", kTiny, "--pipelines", "tilth:no_key=1"}, "no_key"},
      {{"--sources", kTiny, "--base", "floom"}, "--base floom: is not compared"},
      {{"--pipelines", "tilth"}, "--sources: is missing"},
      {{"--sources", kTiny, "--engine", "dask"}, "--scheduler"}};
  for (const auto& [more, words] : cases) {
    const Outcome outcome = compare(more);
    EXPECT_EQ(outcome.exit_code, 1) << words;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << " is not in " << outcome.err;
  }
}

}  // namespace
}  // namespace tilth::app
