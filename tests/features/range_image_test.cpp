// Cells of the range image, ground and clusters, on images made by hand; the numbers are LeGO-LOAM's for the VLP-16.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/features/ground.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A point at `range` [m] in the middle of a cell of 0.2 x 2 degrees.
Eigen::Vector3d point_at(int row, int column, double range) {
  const double azimuth = (column - 900) * 0.2 * kDegree, elevation = (-15 + 2 * row) * kDegree;
  return range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                 std::sin(elevation));
}

struct MadeImage {
  PointCloud cloud;
  RangeImage image;
};

// Cells of a row and columns at a range.
struct Patch {
  int row, first_column, columns;
  double range;
};

MadeImage image_of(const std::vector<Patch>& patches) {
  MadeImage made;
  for (const Patch& patch : patches) {
    for (int i = 0; i < patch.columns; ++i) {
      made.cloud.points.push_back(point_at(patch.row, (patch.first_column + i) % 1800, patch.range));
      made.cloud.rings.push_back(std::uint16_t(patch.row));
    }
  }
  made.image = project(made.cloud, {});
  return made;
}

std::size_t count(const std::vector<CellLabel>& labels, CellLabel label) {
  return std::size_t(std::count(labels.begin(), labels.end(), label));
}

// How many cells are in valid clusters.
std::size_t cells_kept(const std::vector<Patch>& patches) {
  const MadeImage made = image_of(patches);
  const std::vector<std::uint8_t> no_ground(made.image.points.size(), 0);
  return count(cluster(made.image, no_ground, 2.0, {}), CellLabel::cluster);
}

TEST(RangeImage, HasAheadInTheMiddleAndGrowsAnticlockwise) {
  EXPECT_EQ(column_of({5, 0, 0}, 1800), 900);
  EXPECT_EQ(column_of({0, 5, 0}, 1800), 1350);
  EXPECT_EQ(column_of({0, -5, 0}, 1800), 450);
  EXPECT_EQ(column_of({-5, 1e-9, 0}, 1800), 0);
  EXPECT_EQ(column_of({-5, -1e-9, 0}, 1800), 0);
  EXPECT_EQ(column_of({-5, 0.03, 0}, 1800), 1798);  // 0.34 degrees before the seam
  for (int column = 0; column < 1800; ++column) EXPECT_EQ(column_of(point_at(3, column, 7.0), 1800), column);
}

TEST(RangeImage, DropsNearPointsAndForeignRings) {
  PointCloud cloud;
  cloud.points = {{0.99, 0, 0}, {0, 1.01, 0}, {3, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  cloud.rings = {2, 2, 16, 2};
  const RangeImage image = project(cloud, {});
  EXPECT_EQ(std::count(image.points.begin(), image.points.end(), RangeImage::kNone), 16 * 1800 - 1);
  EXPECT_EQ(image.points[image.cell(2, 1350)], 1u);
  EXPECT_FLOAT_EQ(image.ranges[image.cell(2, 1350)], 1.01f);
}

TEST(RangeImage, KeepsTheLastOrTheFirstOfACell) {
  PointCloud cloud;
  cloud.points = {{3, 0, 0}, {4, 0, 0}};
  cloud.rings = {0, 0};
  EXPECT_EQ(project(cloud, {}).points[900], 1u);
  EXPECT_EQ(project(cloud, {.cell_keeps = CellKeeps::first_return}).points[900], 0u);
}

TEST(RangeImage, TellsRowsFromElevationsWhereThereAreNoRings) {
  PointCloud cloud;
  for (int row = 0; row < 16; ++row) cloud.points.push_back(point_at(row, 700, 9.0));
  const RangeImage image = project(cloud, {});
  for (int row = 0; row < 16; ++row) EXPECT_EQ(image.points[image.cell(row, 700)], std::uint32_t(row));
}

// Two beams on a slope: row `row` at 5 m, the next one where the line between them rises by `degrees`.
MadeImage slope_of(double degrees, int row) {
  MadeImage made;
  const Eigen::Vector3d low = point_at(row, 900, 5.0), beam = point_at(row + 1, 900, 1.0);
  const double t = std::tan(degrees * kDegree);
  const double range = (low.z() - t * low.x()) / (beam.z() - t * beam.x());  // low + s (1, 0, t) on the next beam
  made.cloud.points = {low, range * beam};
  made.cloud.rings = {std::uint16_t(row), std::uint16_t(row + 1)};
  made.image = project(made.cloud, {});
  return made;
}

std::size_t ground_cells(const MadeImage& made, const GroundOptions& options) {
  const std::vector<std::uint8_t> ground = mark_ground(made.cloud, made.image, options);
  return std::size_t(std::count(ground.begin(), ground.end(), 1));
}

TEST(Ground, IsNoSteeperThanTenDegrees) {
  EXPECT_EQ(ground_cells(slope_of(0, 6), {}), 2u);
  EXPECT_EQ(ground_cells(slope_of(9.9, 6), {}), 2u);
  EXPECT_EQ(ground_cells(slope_of(10.1, 6), {}), 0u);
  EXPECT_EQ(ground_cells(slope_of(0, 6), {.mount_angle = 9.9}), 2u);
  EXPECT_EQ(ground_cells(slope_of(0, 6), {.mount_angle = 10.1}), 0u);
}

TEST(Ground, IsLookedForFromTheLowestSevenBeamsUp) {
  EXPECT_EQ(ground_cells(slope_of(0, 6), {.max_slope = 80}), 2u);
  EXPECT_EQ(ground_cells(slope_of(12, 7), {.max_slope = 80}), 0u);
}

TEST(Ground, NeedsThePairAboveToBeComplete) {
  MadeImage made = slope_of(0, 2);  // row 3 has nothing above: the pair 3, 4 takes the mark away again
  EXPECT_EQ(mark_ground(made.cloud, made.image, {})[made.image.cell(3, 900)], 0);
  EXPECT_EQ(ground_cells(made, {.rows = 3}), 2u);
}

TEST(Cluster, NeedsThirtyCells) {
  EXPECT_EQ(cells_kept({{3, 100, 29, 8.0}}), 0u);
  EXPECT_EQ(cells_kept({{3, 100, 30, 8.0}}), 30u);
}

TEST(Cluster, OrFiveCellsOnThreeRows) {
  EXPECT_EQ(cells_kept({{3, 100, 1, 1.2}, {4, 100, 1, 1.2}, {5, 100, 3, 1.2}}), 0u);  // the seed's row does not count
  EXPECT_EQ(cells_kept({{3, 100, 2, 1.2}, {4, 100, 1, 1.2}, {5, 100, 2, 1.2}}), 5u);
  EXPECT_EQ(cells_kept({{3, 100, 2, 1.2}, {4, 100, 1, 1.2}, {5, 100, 1, 1.2}}), 0u);
  EXPECT_EQ(cells_kept({{3, 100, 3, 1.2}, {4, 100, 3, 1.2}}), 0u);
}

TEST(Cluster, GoesRoundTheSeamButNotOverTheTop) {
  EXPECT_EQ(cells_kept({{3, 1785, 30, 8.0}}), 30u);
  EXPECT_EQ(cells_kept({{0, 100, 15, 8.0}, {15, 100, 15, 8.0}}), 0u);
}

// Beside each other at 10 m (0.2 degrees apart) the angle falls below 60 degrees from a step of 2.02 cm on.
TEST(Cluster, EndsWhereTheAngleIsBelowSixtyDegrees) {
  const double step = 10 * std::sin(0.2 * kDegree) / std::tan(60 * kDegree);
  EXPECT_EQ(cells_kept({{3, 100, 15, 10.0}, {3, 115, 15, 10.0 + 0.9 * step}}), 30u);
  EXPECT_EQ(cells_kept({{3, 100, 15, 10.0}, {3, 115, 15, 10.0 + 1.1 * step}}), 0u);
}

TEST(Cluster, LeavesTheGroundOut) {
  const MadeImage made = image_of({{3, 100, 60, 8.0}});
  std::vector<std::uint8_t> ground(made.image.points.size(), 0);
  for (int column = 131; column < 140; ++column) ground[made.image.cell(3, column)] = 1;
  const std::vector<CellLabel> labels = cluster(made.image, ground, 2.0, {});
  EXPECT_EQ(count(labels, CellLabel::cluster), 31u);
  EXPECT_EQ(count(labels, CellLabel::ground), 9u);
  EXPECT_EQ(count(labels, CellLabel::noise), 20u);
}

}  // namespace
}  // namespace tilth
