// tilth score-filter as its users run it: figures of a folder and of a scene, and bad input by name.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace tilth::app {
namespace {

using Json = nlohmann::json;

class ScoreFilter : public testing::Test {
 protected:
  std::string simulated(const std::string& format = "pcd") const {
    const std::string folder = (folder_ / format).string();
    const Outcome made = tilth({"simulate", "corridor", "--out", folder, "--seed", "5", "--duration", "1", "--format",
                                format, "--quiet", "--set", "columns=300"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder;
  }
  Json json_of(std::vector<std::string> arguments) const {
    const std::string path = (folder_ / "score.json").string();
    arguments.insert(arguments.begin(), "score-filter");
    arguments.insert(arguments.end(), {"--json", path});
    const Outcome outcome = tilth(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(text_of(path));
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) const {
    const Outcome outcome = tilth(arguments);
    EXPECT_NE(outcome.exit_code, 0);
    for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }

  TemporaryFolder folder_;
};

TEST_F(ScoreFilter, CountsTheLabelsOfAFolder) {
  const std::string folder = simulated();
  std::size_t surface = 0, wrong = 0, scans = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder + "/labels")) {
    ++scans;
    for (const unsigned char label : text_of(file.path())) {
      surface += (label & 127) == 0;
      wrong += (label & 127) >= 1 && (label & 127) <= 3;
    }
  }
  const Json score =
      json_of({folder, "--every", "1", "--set", "outliers.method=none", "min_range=0", "max_range=10000"});
  ASSERT_EQ(score.size(), 1U);
  EXPECT_EQ(score[0]["scans"], scans);
  EXPECT_EQ(score[0]["surface_points"], surface);
  EXPECT_EQ(score[0]["false_points"], wrong);
  EXPECT_EQ(score[0]["removed_outlier"], 0.0);
  EXPECT_EQ(score[0]["kept_edges"], 1.0);
  EXPECT_EQ(score[0]["options"]["outliers.method"], "none");
}

TEST_F(ScoreFilter, FindsTheSameInAFolderABagAndAScene) {
  const Json pcd = json_of({simulated(), "--every", "3"});
  Json bag = json_of({simulated("bag"), "--every", "3"});
  EXPECT_EQ(pcd[0]["removed_outlier"], bag[0]["removed_outlier"]);
  EXPECT_GT(pcd[0]["removed_outlier"], 0.5);
  EXPECT_EQ(pcd[0]["scans"], 3);
  const Json scene = json_of({"corridor", "--seed", "5", "--duration", "1", "--every", "3"});
  EXPECT_EQ(scene[0]["scans"], 3);
  EXPECT_GT(scene[0]["surface_points"], pcd[0]["surface_points"]);  // of all columns
}

TEST_F(ScoreFilter, SweepsReadingsNeighborsAndAlphas) {
  const std::string csv = (folder_ / "sweep.csv").string();
  const Outcome outcome = tilth({"score-filter", simulated(), "--every", "8", "--sweep", "--csv", csv});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string text = text_of(csv);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 2 * 6 * 5 + 1);
  const std::size_t header = text.find('\n');
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(commas(text.substr(0, header)), commas(text.substr(header + 1, text.find('\n', header + 1) - header)));
  EXPECT_NE(outcome.out.find("difference"), std::string::npos);
}

TEST_F(ScoreFilter, RefusesBadInputByName) {
  expect_refused({"score-filter", "corridoor"}, {"corridoor", "hospital"});
  expect_refused({"score-filter", (folder_ / "missing").string()}, {"missing", "no such folder"});
  expect_refused({"score-filter", "corridor", "--every", "0"}, {"--every"});
  expect_refused({"score-filter", "corridor", "--duration", "1", "--set", "outliers.k=1"}, {"outliers.k", "2 .. 64"});
  expect_refused({"score-filter", "corridor", "--duration", "soon"}, {"duration", "soon", "number"});
  expect_refused({"score-filter"}, {"recordings"});
}

TEST_F(ScoreFilter, RefusesLabelsThatAreMissingOrDoNotFit) {
  const std::string folder = simulated(), labels = folder + "/labels/000003.bin";
  expect_refused({"score-filter", folder, "--seed", "3"}, {"--seed", folder});
  std::ofstream(labels, std::ios::app) << "x";
  expect_refused({"score-filter", folder, "--every", "3"}, {"000003.bin", "labels", "points"});
  std::filesystem::remove(labels);
  expect_refused({"score-filter", folder, "--every", "3"}, {"000003.bin"});
  std::filesystem::remove_all(folder + "/labels");
  expect_refused({"score-filter", folder}, {"labels", "tilth simulate"});
}

}  // namespace
}  // namespace tilth::app
