// What a survey of a recording counts, and of what it warns.
#include <gtest/gtest.h>

#include <tilth/sources/scan_survey.hpp>

namespace tilth {
namespace {

Scan scan(double stamp, std::size_t points, double range) {
  Scan made{stamp, {}};
  for (std::size_t i = 0; i < points; ++i) {
    made.cloud.points.emplace_back(range, 0, 0);
    made.cloud.rings.push_back(std::uint16_t(i % 16));
    made.cloud.times.push_back(float(i) * 0.1F / float(points));
    made.cloud.intensities.push_back(float(i % 200));
  }
  return made;
}

bool warns(const ScanSurvey& survey, const std::string& text) {
  for (const std::string& warning : survey_warnings(survey)) {
    if (warning.find(text) != std::string::npos) return true;
  }
  return false;
}

TEST(ScanSurvey, CountsScansPointsAndRanges) {
  ScanSurvey survey;
  for (int i = 0; i < 10; ++i) survey.add(scan(5.0 + 0.1 * i, i == 3 ? 2500 : 3000, i < 5 ? 3.0 : 300.0));
  EXPECT_EQ(survey.scans(), 10U);
  EXPECT_EQ(survey.points(), 29500U);
  EXPECT_EQ(survey.fewest_points(), 2500U);
  EXPECT_EQ(survey.most_points(), 3000U);
  EXPECT_NEAR(survey.duration(), 0.9, 1e-9);
  EXPECT_NEAR(survey.step(), 0.1, 1e-9);
  EXPECT_TRUE(survey.gaps().empty());
  EXPECT_EQ(survey.points_on_rings().size(), 16U);
  EXPECT_EQ(survey.ranges().counts[3], 14500U) << "2 to 5 m";
  EXPECT_EQ(survey.ranges().counts.back(), 15000U) << "beyond the last border";
  EXPECT_EQ(survey.intensities()->borders.back(), 256.0);
  EXPECT_TRUE(survey_warnings(survey).empty()) << survey_warnings(survey).front();
}

TEST(ScanSurvey, NamesGaps) {
  ScanSurvey survey;
  for (int i = 0; i < 20; ++i) survey.add(scan(0.1 * i + (i > 7 ? 0.5 : 0.0), 3000, 3.0));
  ASSERT_EQ(survey.gaps().size(), 1U);
  EXPECT_EQ(survey.gaps()[0].before, 7U);
  EXPECT_NEAR(survey.gaps()[0].seconds, 0.6, 1e-9);
  EXPECT_TRUE(warns(survey, "0.60 s pass after scan 7"));
}

TEST(ScanSurvey, WarnsOfScansThatLastLongerThanTheirSteps) {
  ScanSurvey right, twice;
  for (int i = 0; i < 20; ++i) {
    right.add(scan(0.1 * i, 3000, 3.0));
    twice.add(scan(0.05 * i, 3000, 3.0));
  }
  EXPECT_FALSE(warns(right, "do not run at the same speed"));
  EXPECT_TRUE(warns(twice, "scans come every 0.050 s"));
}

TEST(ScanSurvey, WarnsOfWhatIsMissingOrOdd) {
  ScanSurvey bare;
  EXPECT_TRUE(warns(bare, "not one scan"));
  Scan plain = scan(0.0, 100, 0.7);
  plain.cloud.rings.clear(), plain.cloud.times.clear();
  plain.cloud.intensities.assign(100, 3.0F);
  bare.add(plain);
  EXPECT_TRUE(warns(bare, "only one scan"));
  EXPECT_TRUE(warns(bare, "no times of their own"));
  EXPECT_TRUE(warns(bare, "which beam"));
  EXPECT_TRUE(warns(bare, "Only 100 points"));
  EXPECT_TRUE(warns(bare, "100 % of the points lie nearer than 1 m"));
  EXPECT_TRUE(warns(bare, "intensities are alike"));
  plain.stamp = 1.0;
  bare.add(plain);
  EXPECT_TRUE(warns(bare, "1.0 scans a second are unusual"));
}

}  // namespace
}  // namespace tilth
