// Counts of a filter's score on a scan made by hand.
#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/filter_score.hpp>

namespace tilth {
namespace {

/// Ten points 1 m apart along x: six surface (two of them on an edge), outlier, mixed, ghost, moving; and one mixed
/// point 10 cm from the first.
LabelledCloud made_scan() {
  LabelledCloud scan;
  for (int i = 0; i < 10; ++i) scan.cloud.points.push_back({1.0 + i, 0, 0});
  scan.cloud.points.push_back({1.0, 0.1, 0});
  scan.labels = {0, 0, 128, 128, 0, 0, 1, 2 + 128, 3, 4, 2};
  scan.obvious = mark_obvious(scan.cloud, scan.labels);
  return scan;
}

TEST(FilterScore, CountsByKindEdgeAndRange) {
  const LabelledCloud scan = made_scan();
  const FilterScore score = score_filter(scan, std::vector<std::uint8_t>{1, 1, 1, 0, 1, 1, 0, 1, 0, 1, 0});
  EXPECT_EQ(score.scans, 1U);
  EXPECT_NEAR(score.of(PointKind::surface).kept_ratio(), 5.0 / 6, 1e-12);
  EXPECT_EQ(score.of(PointKind::outlier).removed_ratio(), 1.0);
  EXPECT_EQ(score.of(PointKind::mixed).removed_ratio(), 0.5);
  EXPECT_EQ(score.of(PointKind::ghost).removed_ratio(), 1.0);
  EXPECT_EQ(score.of(PointKind::moving).kept_ratio(), 1.0);
  EXPECT_EQ(score.edges.kept_ratio(), 0.5);
  EXPECT_EQ(score.false_points().before, 4U);
  EXPECT_NEAR(score.accuracy(), 9.0 / 11, 1e-12);  // wrong: one edge point removed, one mixed point kept
  EXPECT_NEAR(score.precision(), 3.0 / 4, 1e-12);
  EXPECT_EQ(score.surface_by_range[0].before, 1U);  // 1 m
  EXPECT_EQ(score.surface_by_range[1].before, 3U);  // 2, 3, 4 m
  EXPECT_EQ(score.surface_by_range[1].kept, 2U);
  EXPECT_EQ(score.surface_by_range[2].before, 2U);  // 5, 6 m
}

TEST(FilterScore, CallsObviousWhatLiesClearOfSurfaces) {
  const LabelledCloud scan = made_scan();
  EXPECT_EQ(scan.obvious, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0}));
  const FilterScore score = score_filter(scan, std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1});
  EXPECT_EQ(score.obvious.before, 2U);
  EXPECT_EQ(score.obvious.kept, 1U);
}

TEST(FilterScore, CountsFalseFeatures) {
  const LabelledCloud scan = made_scan();
  const std::vector<std::uint32_t> edges{0, 2, 3, 6, 7, 9}, planes{1, 4, 5, 8};
  FilterScore score;
  score.features_before = count_features(scan.labels, edges, planes);
  EXPECT_EQ(score.features_before.false_edges, 2U);  // 6 outlier, 7 mixed
  EXPECT_EQ(score.features_before.off_edge, 2U);     // 0 plain surface, 9 moving
  EXPECT_EQ(score.features_before.false_planes, 1U);
  EXPECT_NEAR(score.features_before.false_ratio(), 0.3, 1e-12);
  score.features_after = count_features(scan.labels, std::vector<std::uint32_t>{0, 2, 6}, {});
  EXPECT_NEAR(score.pseudo_reduction(), 0.5, 1e-12);
}

TEST(FilterScore, AddsUp) {
  const LabelledCloud scan = made_scan();
  const std::vector<std::uint8_t> all(11, 1), none(11, 0);
  FilterScore score = score_filter(scan, all);
  score += score_filter(scan, none);
  EXPECT_EQ(score.scans, 2U);
  EXPECT_EQ(score.edges.before, 4U);
  EXPECT_EQ(score.edges.kept_ratio(), 0.5);
  EXPECT_EQ(score.obvious.before, 4U);
  EXPECT_NEAR(score.accuracy(), (7.0 + 4.0) / 22, 1e-12);
}

TEST(FilterScore, SharesOfNothingAreHarmless) {
  const FilterScore score;
  EXPECT_EQ(score.of(PointKind::ghost).removed_ratio(), 0.0);
  EXPECT_EQ(score.of(PointKind::ghost).kept_ratio(), 1.0);
  EXPECT_EQ(score.precision(), 0.0);
}

TEST(FilterScore, RefusesLengthsThatDifferAndUnknownKinds) {
  LabelledCloud scan = made_scan();
  EXPECT_THROW(score_filter(scan, std::vector<std::uint8_t>(10, 1)), Error);
  scan.labels[3] = 9;
  EXPECT_THROW(score_filter(scan, std::vector<std::uint8_t>(11, 1)), Error);
  scan.labels.pop_back();
  EXPECT_THROW(mark_obvious(scan.cloud, scan.labels), Error);
}

}  // namespace
}  // namespace tilth
