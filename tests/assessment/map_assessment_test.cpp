// A hall of known walls, mapped well, and mapped twice with the second visit displaced.
#include <random>

#include <gtest/gtest.h>

#include <tilth/assessment/map_assessment.hpp>

namespace tilth {
namespace {

struct Displaced {
  Eigen::Vector3f by = Eigen::Vector3f::Zero();
  float noise = 0.01F;
  bool outside = false;  ///< the second visit sees the walls from without
};

/// Walls and floor of 12 x 8 x 3 m at steps of 7 cm, seen once in scans 0 to 99 and once in scans 100 to 199.
std::vector<ScannedPoint> hall(const Displaced& second) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, second.noise);
  std::vector<ScannedPoint> points;
  for (std::uint32_t visit = 0; visit < 2; ++visit) {
    const Eigen::Vector3f shift = visit == 1 ? second.by : Eigen::Vector3f::Zero();
    const Eigen::Vector3f from(visit == 1 && second.outside ? 40.0F : 0.0F, 0, 1);
    const auto add = [&](float x, float y, float z) {
      const Eigen::Vector3f p(x + noise(random), y + noise(random), z + noise(random));
      points.push_back({p + shift, from, 100 * visit + std::uint32_t(points.size() % 100)});
    };
    for (float a = -6; a <= 6; a += 0.07F) {
      for (float b = -4; b <= 4; b += 0.07F) add(a, b, 0.2F);
    }
    for (float z = 0; z <= 3; z += 0.07F) {
      for (float y = -4; y <= 4; y += 0.07F) add(6.3F, y, z);
    }
  }
  return points;
}

std::vector<AssessedScan> scans() {
  std::vector<AssessedScan> all;
  for (int i = 0; i < 200; ++i) all.push_back({1000 + 0.5 * i});
  return all;
}

TEST(MapAssessment, CallsAMapGoodThatIs) {
  const MapAssessment found = assess_map(hall({}), scans());
  EXPECT_EQ(found.verdict(), "good");
  EXPECT_NEAR(found.quality.thickness_median, 0.01, 0.002);
  EXPECT_NEAR(found.quality.plane_variance, 1e-4, 0.3e-4);
  EXPECT_GT(found.quality.planes, 400U);
}

TEST(MapAssessment, FindsAWallThatIsThereTwiceWithItsGapPlaceAndMinute) {
  for (const float gap : {0.06F, 0.12F, 0.25F}) {
    const DoubledWalls found = doubled_walls(hall({.by = {gap, 0, 0}}));
    ASSERT_FALSE(found.walls.empty()) << gap;
    EXPECT_NEAR(found.walls[0].gap, gap, 0.01) << gap;
    EXPECT_NEAR(found.walls[0].place.x(), 6.3 + gap / 2, 0.05) << gap;
    EXPECT_GE(found.walls[0].scan, 100U);
    EXPECT_GT(found.walls[0].cells, 10U);
  }
  const std::string verdict = assess_map(hall({.by = {0.12F, 0, 0}}), scans()).verdict();
  EXPECT_NE(verdict.find("look at minute 2"), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("two walls 12 cm apart"), std::string::npos) << verdict;
}

TEST(MapAssessment, TellsADoubledWallFromOneSeenFromBothSides) {
  EXPECT_EQ(doubled_walls(hall({.by = {0.12F, 0, 0}, .outside = true})).doubled, 0U);
}

TEST(MapAssessment, TellsNothingOfWallsFartherApart) {
  EXPECT_EQ(doubled_walls(hall({.by = {0.6F, 0, 0}})).doubled, 0U);
}

TEST(MapAssessment, ABlurredMapHasMoreEntropyAndThickerSurfaces) {
  const MapQuality sharp = assess_map(hall({}), scans()).quality,
                   blurred = assess_map(hall({.noise = 0.03F}), scans()).quality;
  EXPECT_LT(sharp.entropy + 0.2, blurred.entropy);
  EXPECT_GT(blurred.thickness_median, 2 * sharp.thickness_median);
  EXPECT_NE(assess_map(hall({.noise = 0.03F}), scans()).verdict().find("thick"), std::string::npos);
  EXPECT_NE(assess_map(hall({.noise = 0.08F}), scans()).verdict().find("hardly a surface is flat"), std::string::npos);
}

TEST(MapAssessment, TellsOfALostTrack) {
  std::vector<AssessedScan> lost = scans();
  lost[30].track = TrackState::lost;
  const MapAssessment found = assess_map(hall({}), lost);
  EXPECT_EQ(found.verdict(), "look at minute 1 (15 s): the track was lost");
  EXPECT_EQ(found.not_tracked, 1U);
}

TEST(MapAssessment, SaysWhereThereIsNothingToJudge) {
  EXPECT_NE(assess_map({}, {}).verdict().find("too few points"), std::string::npos);
  const std::vector<ScannedPoint> bad(
      100, {Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()), Eigen::Vector3f::Zero(), 0});
  EXPECT_NE(assess_map(bad, {}).verdict().find("too few points"), std::string::npos);
}

}  // namespace
}  // namespace tilth
