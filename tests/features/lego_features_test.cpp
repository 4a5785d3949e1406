// LeGO-LOAM's features on made-up rows: a wall, a corner, an edge that hides what is behind it.
#include <numeric>

#include <gtest/gtest.h>

#include <tilth/features/lego_features.hpp>

namespace tilth {
namespace {

// One row of ranges [m], a point a column; the points lie along x.
RowScan row_of(const std::vector<float>& ranges) {
  RowScan scan;
  scan.ranges = ranges;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    scan.cloud.points.push_back({0.5 * double(i), double(ranges[i]), 0});
    scan.columns.push_back(std::uint16_t(i));
  }
  scan.cloud.rings.assign(ranges.size(), 3);
  scan.row_begin = {0, std::uint32_t(ranges.size())};
  return scan;
}

// A row with a spike of `height` [m], within reason for a point that is used, at every `every` points.
SegmentedScan spikes(std::size_t points, std::size_t every, float height, bool ground) {
  std::vector<float> ranges(points, 20.0f);
  for (std::size_t i = every / 2; i < points; i += every) ranges[i] += height;
  SegmentedScan scan;
  scan.rows = row_of(ranges);
  scan.ground.assign(points, ground);
  return scan;
}

std::vector<std::size_t> marked(const std::vector<std::uint8_t>& marks) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i]) indices.push_back(i);
  }
  return indices;
}

std::vector<std::size_t> range(std::size_t first, std::size_t last) {
  std::vector<std::size_t> indices(last - first + 1);
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

TEST(RangeCurvature, IsTheSquareOfTenNeighboursLessTenTimesTheRange) {
  std::vector<float> ranges(21, 5.0f);
  EXPECT_EQ(range_curvature(ranges), std::vector<double>(21, 0.0));
  ranges[10] = 5.25f;
  const std::vector<double> c = range_curvature(ranges);
  EXPECT_DOUBLE_EQ(c[10], 2.5 * 2.5);
  for (const std::size_t i : {5, 9, 11, 15}) EXPECT_DOUBLE_EQ(c[i], 0.25 * 0.25) << i;
  EXPECT_EQ(c[4], 0.0);
  EXPECT_EQ(c[16], 0.0);
}

TEST(UnusablePoints, AreTheFarSideOfAStepOfThirtyCentimetres) {
  std::vector<float> ranges(40, 100.0f);  // 2 % are 2 m
  std::fill(ranges.begin() + 20, ranges.end(), 99.71f);
  EXPECT_TRUE(marked(unusable_points(row_of(ranges))).empty());
  std::fill(ranges.begin() + 20, ranges.end(), 99.69f);
  EXPECT_EQ(marked(unusable_points(row_of(ranges))), range(14, 19));
  std::fill(ranges.begin() + 20, ranges.end(), 100.31f);
  EXPECT_EQ(marked(unusable_points(row_of(ranges))), range(20, 25));
}

TEST(UnusablePoints, AreNotMarkedAcrossAGapOfTenColumns) {
  std::vector<float> ranges(40, 100.0f);
  std::fill(ranges.begin() + 20, ranges.end(), 98.5f);
  for (const int gap : {9, 10}) {
    RowScan scan = row_of(ranges);
    for (std::size_t i = 20; i < 40; ++i) scan.columns[i] = std::uint16_t(19 + gap + int(i) - 20);
    EXPECT_EQ(marked(unusable_points(scan)).empty(), gap == 10);
  }
}

TEST(UnusablePoints, StandOutFromBothSidesByTwoPercent) {
  std::vector<float> ranges(40, 10.0f);
  ranges[20] = 10.19f;
  EXPECT_TRUE(marked(unusable_points(row_of(ranges))).empty());
  ranges[20] = 10.22f;
  EXPECT_EQ(marked(unusable_points(row_of(ranges))), range(20, 20));
}

TEST(Suppression, ReachesFivePointsAndEndsAtAGapOfMoreThanTenColumns) {
  RowScan scan = row_of(std::vector<float>(40, 10.0f));
  std::vector<std::uint8_t> marks(40, 0);
  suppress_around(20, scan.columns, marks);
  EXPECT_EQ(marked(marks), range(15, 25));
  for (std::size_t i = 23; i < 40; ++i) scan.columns[i] = std::uint16_t(scan.columns[i] + 10);
  for (std::size_t i = 0; i < 18; ++i) scan.columns[i] = 0;
  marks.assign(40, 0);
  suppress_around(20, scan.columns, marks);
  EXPECT_EQ(marked(marks), range(18, 22));
}

TEST(Sectors, AreSixBetweenTheMargins) {
  const RowScan scan = row_of(std::vector<float>(131, 10.0f));
  const std::vector<Sector> sectors = sectors_of_row(scan, 0);
  ASSERT_EQ(sectors.size(), 6u);
  EXPECT_EQ(sectors[0].begin, 5u);
  for (const Sector& s : sectors) EXPECT_EQ(s.end - s.begin, 20u);
  EXPECT_EQ(sectors[5].end, 125u);  // the point 125 is the last before the margin
  EXPECT_TRUE(sectors_of_row(row_of(std::vector<float>(10, 1.0f)), 0).empty());
  EXPECT_TRUE(sectors_of_row(row_of({}), 0).empty());
}

TEST(ByCurvature, SortsAllOrAllButTheLast) {
  const std::vector<double> c{9, 4, 1, 3, 2};
  EXPECT_EQ(by_curvature({1, 5}, c, false), (std::vector<std::uint32_t>{2, 4, 3, 1}));
  EXPECT_EQ(by_curvature({0, 4}, c, true), (std::vector<std::uint32_t>{2, 1, 0, 3}));
}

// 1,811 points make six sectors of 300 points, with 25 spikes each.
TEST(LegoFeatures, AreTwoSharpAndTwentyLessSharpOfASector) {
  const LegoFeatures f = lego_features(spikes(1811, 12, 0.25f, false), {});
  EXPECT_EQ(f.sharp.size(), 12u);
  EXPECT_EQ(f.less_sharp.size(), 120u);
  EXPECT_TRUE(f.flat.empty());
  EXPECT_EQ(f.less_sharp.rings, std::vector<std::uint16_t>(120, 3));
}

TEST(LegoFeatures, AreEdgesAboveAndFlatsBelowACurvatureOfATenth) {
  EXPECT_EQ(lego_features(spikes(1811, 60, 0.033f, false), {}).sharp.size(), 12u);  // (0.33 m)^2
  EXPECT_EQ(lego_features(spikes(1811, 60, 0.031f, false), {}).sharp.size(), 0u);
  EXPECT_EQ(lego_features(spikes(1811, 60, 0.033f, true), {}).sharp.size(), 0u);  // no edges on the ground
}

TEST(LegoFeatures, AreFourFlatOfASectorOnTheGroundAlone) {
  const LegoFeatures ground = lego_features(spikes(1811, 60, 0.0f, true), {});
  EXPECT_EQ(ground.flat.size(), 24u);
  EXPECT_TRUE(lego_features(spikes(1811, 60, 0.0f, false), {}).flat.empty());
  EXPECT_EQ(ground.flat.points[0].x(), 0.5 * 5);
  EXPECT_EQ(ground.flat.points[1].x(), 0.5 * 11);  // the next one that five neighbours leave
}

// Points stand 0.5 m apart, so no two share a cell of 0.2 m: every point of the sectors is there but the edges.
TEST(LegoFeatures, AreLessFlatWhatIsNoEdge) {
  EXPECT_EQ(lego_features(spikes(1811, 12, 0.25f, false), {}).less_flat.size(), 1800u - 120u);
  EXPECT_EQ(lego_features(spikes(1811, 12, 0.0f, true), {}).less_flat.size(), 1800u);
  EXPECT_LT(lego_features(spikes(1811, 12, 0.0f, true), {.less_flat_voxel = 5}).less_flat.size(), 190u);
}

// A plane of ground: 1,800 columns of the rows 0 .. 7, flat enough for each pair of rows.
TEST(Segmentation, KeepsOneGroundPointInFiveAndTheSeam) {
  PointCloud cloud;
  for (int row = 0; row < 8; ++row) {
    for (int i = 0; i < 1800; ++i) {
      const double azimuth = (i - 900) * 0.2 * M_PI / 180, distance = 4.0 + row;
      cloud.points.push_back({distance * std::cos(azimuth), distance * std::sin(azimuth), -1.0});
      cloud.rings.push_back(std::uint16_t(row));
    }
  }
  const SegmentedScan scan = segment(cloud, {});
  const std::size_t in_row = 360 + 5 + 4;  // of five columns one; 1 .. 5 without 5, and 1795 .. 1799 without 1795
  for (std::size_t row = 0; row < 8; ++row)
    EXPECT_EQ(scan.rows.row_begin[row + 1] - scan.rows.row_begin[row], in_row - 1);
  EXPECT_EQ(std::accumulate(scan.ground.begin(), scan.ground.end(), 0), 8 * (int(in_row) - 1));
  EXPECT_TRUE(scan.outliers.empty());
}

// Isolated returns, one in each of 50 columns of every row: outliers where the row is above the seventh, one column in
// five.
TEST(Segmentation, KeepsNoiseAboveTheGroundRowsAsOutliers) {
  PointCloud cloud;
  for (int row = 0; row < 16; ++row) {
    for (int i = 0; i < 50; ++i) {
      const double azimuth = (i - 25) * 0.2 * M_PI / 180, elevation = (-15 + 2 * row) * M_PI / 180;
      const double r = 5 + (i + row) % 2 * 10;
      cloud.points.push_back({r * std::cos(elevation) * std::cos(azimuth), r * std::cos(elevation) * std::sin(azimuth),
                              r * std::sin(elevation)});
      cloud.rings.push_back(std::uint16_t(row));
    }
  }
  SegmentationOptions options;
  options.ground.max_slope = 0;
  const SegmentedScan scan = segment(cloud, options);
  EXPECT_EQ(scan.rows.cloud.size(), 0u);
  EXPECT_EQ(scan.outliers.size(), 8u * 10u);  // rows 8 .. 15
  EXPECT_EQ(std::count(scan.keep.begin(), scan.keep.end(), 0), 16 * 50);
}

}  // namespace
}  // namespace tilth
