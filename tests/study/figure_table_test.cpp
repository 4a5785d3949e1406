// One table, four ways to show it.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <tilth/study/figure_table.hpp>

namespace tilth {
namespace {

FigureTable sample() {
  FigureTable table{"Made up", {{"name", "name"}, {"error_m", "error", 3}}, {}, {"A note."}};
  table.rows.push_back({std::string("a|b"), 1.23456});
  table.rows.push_back({std::string("say \"x\", y"), Figure()});
  return table;
}

TEST(FigureTable, SetsNumbersToTheRightAndWordsToTheLeft) {
  EXPECT_EQ(table_text(sample()),
            "Made up\n"
            "name        error\n"
            "a|b         1.235\n"
            "say \"x\", y      -\n"
            "A note.\n");
}

TEST(FigureTable, EscapesWhatMarkdownWouldTakeForItsOwn) {
  EXPECT_EQ(table_markdown(sample()),
            "**Made up**\n\n| name | error |\n|---|--:|\n| a\\|b | 1.235 |\n| say \"x\", y | - |\n\nA note.\n");
  FigureTable hostile{"<b>", {{"n", "n"}}, {{std::string("<img src=x>\nnew line")}}, {}};
  const std::string text = table_markdown(hostile);
  EXPECT_EQ(text.find("<img"), text.find("\\<img") + 1);
  EXPECT_NE(text.find("\\> new line |"), std::string::npos) << text;
}

TEST(FigureTable, QuotesCsvAndKeepsAllDigits) {
  EXPECT_EQ(table_csv(sample()), "name,error_m\na|b,1.23456\n\"say \"\"x\"\", y\",\n");
}

TEST(FigureTable, SaysTheSameInJson) {
  const FigureTable table = sample();
  const std::string name = "made";
  const auto json = nlohmann::json::parse(tables_json({&name, 1}, {&table, 1}));
  EXPECT_EQ(json["made"]["title"], "Made up");
  EXPECT_EQ(json["made"]["notes"][0], "A note.");
  EXPECT_EQ(json["made"]["rows"][0]["error_m"], 1.23456);
  EXPECT_EQ(json["made"]["rows"][1]["name"], "say \"x\", y");
  EXPECT_TRUE(json["made"]["rows"][1]["error_m"].is_null());
}

TEST(FigureTable, WritesCountsWithoutAPoint) {
  FigureTable table{"t", {{"x", "x"}, {"y", "y"}}, {{12.0, 0.5}}, {}};
  EXPECT_EQ(table_csv(table), "x,y\n12,0.5\n");
}

TEST(FigureTable, HasNoNumberThatIsNotFinite) {
  FigureTable table{"t", {{"x", "x", 1}}, {{std::nan("")}, {HUGE_VAL}}, {}};
  EXPECT_EQ(table_csv(table), "x\n\n\n");
  EXPECT_EQ(table_text(table), "t\nx\n-\n-\n");
}

}  // namespace
}  // namespace tilth
