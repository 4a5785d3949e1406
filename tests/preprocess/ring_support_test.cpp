// The filter by the beams beside a point: made scans with known outliers, and the paper's figures on simulated ones.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/evaluation/filter_score.hpp>
#include <tilth/preprocess/outlier_removal.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

constexpr int kColumns = 900, kRings = 8;

Eigen::Vector3d beam(int column, int ring) {
  const double azimuth = 2 * std::numbers::pi * (column + 0.5) / kColumns, elevation = 0.035 * (ring - 3.5);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

/// A room of 4 m by 60 m without noise, in firing order: its far walls are grazed at 88 degrees.
PointCloud long_room() {
  PointCloud cloud;
  for (int column = 0; column < kColumns; ++column) {
    for (int ring = 0; ring < kRings; ++ring) {
      const Eigen::Vector3d ray = beam(column, ring);
      const double range = std::min(2 / std::abs(ray.y()), 30 / std::abs(ray.x()));
      cloud.points.push_back(range * ray);
      cloud.rings.push_back(std::uint16_t(ring));
    }
  }
  return cloud;
}

std::size_t index_of(int column, int ring) {
  return std::size_t(column * kRings + ring);
}

void move_to(PointCloud& cloud, int column, int ring, double range) {
  cloud.points[index_of(column, ring)] = range * beam(column, ring);
}

std::vector<std::uint8_t> supported(const PointCloud& cloud) {
  const auto keep = ring_support(cloud, {});
  EXPECT_TRUE(keep);
  return keep.value_or(std::vector<std::uint8_t>{});
}

TEST(RingSupport, KeepsAllOfAnEmptyRoom) {
  const auto keep = supported(long_room());
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 0);
}

TEST(RingSupport, RemovesIsolatedPointsBeforeAndBehindTheWall) {
  PointCloud cloud = long_room();
  move_to(cloud, 100, 2, 1.0);
  move_to(cloud, 250, 0, 1.7);
  move_to(cloud, 400, 7, 5.0);
  move_to(cloud, 0, 3, 12.0);  // where the ring begins
  const auto keep = supported(cloud);
  for (const std::size_t i : {index_of(100, 2), index_of(250, 0), index_of(400, 7), index_of(0, 3)}) {
    EXPECT_EQ(keep[i], 0) << i;
  }
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 4);
}

TEST(RingSupport, RemovesThePointBetweenTwoSurfaces) {
  PointCloud cloud = long_room();
  for (int ring = 0; ring < kRings; ++ring) {
    for (int column = 210; column < 230; ++column) move_to(cloud, column, ring, 1.0);
  }
  move_to(cloud, 230, 4, 1.5);  // before a wall at 2 m
  const auto keep = supported(cloud);
  EXPECT_EQ(keep[index_of(230, 4)], 0);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 1);
}

TEST(RingSupport, KeepsAPoleOneBeamWide) {
  PointCloud cloud = long_room();
  for (const int ring : {3, 4}) {
    const double level = std::hypot(beam(300, ring).x(), beam(300, ring).y());
    move_to(cloud, 300, ring, 1.2 / level);
  }
  const auto keep = supported(cloud);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 0);
}

TEST(RingSupport, KeepsABarOneRingHigh) {
  PointCloud cloud = long_room();
  for (int column = 300; column < 304; ++column) move_to(cloud, column, 5, 1.2);
  const auto keep = supported(cloud);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 0), 0);
}

TEST(RingSupport, ScalesWithTheNoiseAllowed) {
  PointCloud cloud = long_room();
  move_to(cloud, 225, 4, 2 + 0.15);
  EXPECT_EQ((*ring_support(cloud, {.noise = 0.02}))[index_of(225, 4)], 0);
  EXPECT_EQ((*ring_support(cloud, {.noise = 0.05}))[index_of(225, 4)], 1);
}

TEST(RingSupport, SaysWhereRingsGiveNoOrder) {
  PointCloud cloud = long_room();
  cloud.rings.clear();
  EXPECT_FALSE(ring_support(cloud, {}));
  EXPECT_FALSE(ring_support({}, {}));
  const NeighborTable table = scan_neighbors(cloud, 10);
  EXPECT_EQ(keep_inliers(cloud, table, {.method = OutlierMethod::support}),
            keep_inliers(cloud, table, {.method = OutlierMethod::weighted}));
}

TEST(RingSupport, DoesNotLetAPointSupportItself) {
  PointCloud isolated;
  isolated.points = {{3, 0, 0}};
  isolated.rings = {0};
  EXPECT_FALSE(ring_support(isolated, {}));
}

/// The default filter on every 40th scan of a scene.
FilterScore score_of(const std::string& scene) {
  const Simulator simulator(scene, simulation_options(scene, {{"seed", "57"}}));
  FilterScore score;
  for (std::size_t i = 20; i < simulator.size(); i += 40) {
    LabelledScan made = simulator.scan(i);
    LabelledCloud scan{std::move(made.scan.cloud), std::move(made.labels), {}};
    scan.obvious = mark_obvious(scan.cloud, scan.labels);
    score += score_filter(scan, keep_inliers(scan.cloud, scan_neighbors(scan.cloud, 10), {}));
  }
  return score;
}

TEST(RingSupport, ReachesThePapersFiguresByDefault) {
  for (const char* scene : {"corridor", "plaza", "hospital"}) {
    const FilterScore score = score_of(scene);
    EXPECT_GT(score.of(PointKind::outlier).before, 1000U) << scene;
    EXPECT_GT(score.of(PointKind::outlier).removed_ratio(), 0.94) << scene;
    EXPECT_GT(score.obvious.removed_ratio(), 0.93) << scene;
    EXPECT_GT(score.edges.kept_ratio(), 0.99) << scene;
    EXPECT_GT(score.of(PointKind::surface).kept_ratio(), 0.985) << scene;
    EXPECT_GT(score.of(PointKind::moving).kept_ratio(), 0.99) << scene;
    EXPECT_GT(score.accuracy(), 0.98) << scene;
    for (const KeptCount& count : score.surface_by_range) {
      if (count.before > 500) {
        EXPECT_GT(count.kept_ratio(), 0.95) << scene;
      }
    }
  }
}

}  // namespace
}  // namespace tilth
