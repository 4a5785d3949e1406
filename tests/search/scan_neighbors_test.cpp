#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "search/generated_scans.hpp"
#include "search/neighbor_checks.hpp"
#include "support/real_recording.hpp"
#include <tilth/search/neighbor_moments.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth {
namespace {

using generated::kCorridor;
using generated::kOpenGround;
using generated::kRoom;
using generated::make_scan;
using generated::ScanShape;
using testing_search::expect_exact;

TEST(ScanNeighbors, are_exact_on_whole_scans) {
  ScanNeighbors search;
  for (const generated::Place& place : {kRoom, kCorridor, kOpenGround}) {
    for (const bool ring_major : {false, true}) {
      for (const std::size_t k : {1, 5, 10, 20, 30}) {
        const PointCloud scan = make_scan({.place = place, .ring_major = ring_major, .clockwise = ring_major}, 7);
        SCOPED_TRACE(testing::Message() << "room half size " << place.x << ", ring major " << ring_major << ", k "
                                        << k);
        ASSERT_NO_FATAL_FAILURE(expect_exact(scan, search.compute(scan, k), k));
      }
    }
  }
}

TEST(ScanNeighbors, are_exact_on_thousands_of_small_scans) {
  std::mt19937 random(1);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  ScanNeighbors search;
  for (int n = 0; n < 2000; ++n) {
    ScanShape shape{.place = n % 3 == 0 ? kRoom : n % 3 == 1 ? kCorridor : kOpenGround};
    shape.rings = pick(1, 24);
    shape.columns = pick(1, 60);
    shape.overlap = pick(0, 3);
    shape.noise = pick(0, 1) * 0.02;
    shape.missing = 0.3 * pick(0, 2);
    shape.outliers = 0.2 * pick(0, 2);
    shape.ring_major = pick(0, 1);
    shape.clockwise = pick(0, 1);
    const PointCloud scan = make_scan(shape, std::uint32_t(n));
    const std::size_t k = std::size_t(pick(0, 40));
    SCOPED_TRACE(testing::Message() << "scan " << n << ", " << scan.size() << " points, k " << k);
    ASSERT_NO_FATAL_FAILURE(expect_exact(scan, search.compute(scan, k), k));
  }
}

PointCloud with_rings(std::vector<Eigen::Vector3d> points, int rings) {
  PointCloud cloud;
  cloud.points = std::move(points);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.rings.push_back(std::uint16_t(i % std::size_t(rings)));
  return cloud;
}

void expect_exact_for_all_k(const PointCloud& cloud) {
  for (const std::size_t k : {1, 2, 7, 10, 13, 20, 30, 45, 100000}) {
    SCOPED_TRACE(testing::Message() << cloud.size() << " points, k " << k);
    ASSERT_NO_FATAL_FAILURE(expect_exact(cloud, scan_neighbors(cloud, k), k));
  }
}

TEST(ScanNeighbors, of_nothing_and_of_one_point) {
  EXPECT_EQ(scan_neighbors({}, 10).size(), 0u);
  for (const int n : {1, 2, 3}) {
    expect_exact_for_all_k(with_rings(std::vector<Eigen::Vector3d>(std::size_t(n), Eigen::Vector3d(1, 2, 3)), 2));
  }
}

TEST(ScanNeighbors, bear_duplicates_and_missing_returns_at_the_origin) {
  std::mt19937 random(2);
  PointCloud scan = make_scan({.place = kRoom, .columns = 40}, 2);
  for (std::size_t i = 0; i + 16 < scan.size(); ++i) {
    if (random() % 3 == 0) scan.points[i + 16] = scan.points[i];
    if (random() % 5 == 0) scan.points[i].setZero();
  }
  expect_exact_for_all_k(scan);
  expect_exact_for_all_k(with_rings(std::vector<Eigen::Vector3d>(300, Eigen::Vector3d(1, 2, 3)), 4));
  expect_exact_for_all_k(with_rings(std::vector<Eigen::Vector3d>(300, Eigen::Vector3d::Zero()), 4));
}

TEST(ScanNeighbors, bear_ties) {
  const PointCloud circles =
      make_scan({.place = kOpenGround, .columns = 36, .noise = 0, .missing = 0, .outliers = 0}, 1);
  expect_exact_for_all_k(circles);
  std::vector<Eigen::Vector3d> grid;
  for (int i = 0; i < 600; ++i) grid.emplace_back(i % 10 - 4, i / 10 % 10 - 4, i / 100);
  expect_exact_for_all_k(with_rings(grid, 6));
}

TEST(ScanNeighbors, bear_points_on_the_axis_and_in_one_direction) {
  std::vector<Eigen::Vector3d> axis, ray;
  for (int i = 1; i <= 200; ++i) {
    axis.emplace_back(0, 0, 0.01 * i * (i % 2 == 0 ? 1 : -1));
    ray.push_back(0.03 * i * Eigen::Vector3d(1, -2, 0.3));
  }
  expect_exact_for_all_k(with_rings(axis, 2));
  expect_exact_for_all_k(with_rings(ray, 3));
  PointCloud scan = make_scan({.place = kRoom, .columns = 30}, 3);
  for (std::size_t i = 0; i < scan.size(); i += 7) scan.points[i].head<2>().setZero();
  expect_exact_for_all_k(scan);
}

TEST(ScanNeighbors, need_no_order_and_no_rings) {
  std::mt19937 random(4);
  const PointCloud scan = make_scan({.place = kCorridor, .columns = 60, .overlap = 2}, 4);
  std::vector<std::uint32_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), random);
  PointCloud shuffled = select(scan, order);
  expect_exact_for_all_k(shuffled);
  for (std::uint16_t& ring : shuffled.rings) ring = std::uint16_t(random() % 5);
  expect_exact_for_all_k(shuffled);
  shuffled.rings.clear();
  expect_exact_for_all_k(shuffled);
}

TEST(ScanNeighbors, are_the_same_for_every_instruction_set) {
  const PointCloud scan = make_scan({.place = kCorridor, .columns = 300, .overlap = 3}, 5);
  for (const std::size_t k : {3, 10, 20, 30}) {
    const NeighborTable best = scan_neighbors(scan, k);
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
      hwy::SetSupportedTargetsForTest(left & -left);
      const NeighborTable table = scan_neighbors(scan, k);
      const auto covariances = local_covariances(scan, table);
      hwy::SetSupportedTargetsForTest(0);
      ASSERT_NO_FATAL_FAILURE(expect_exact(scan, table, k));
      ASSERT_EQ(table.indices, best.indices) << hwy::TargetName(left & -left);
      ASSERT_EQ(covariances.xy, local_covariances(scan, best).xy) << hwy::TargetName(left & -left);
    }
  }
}

// Records of 14 bytes: x, y, z as float, intensity, ring.
PointCloud read_scan(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (std::getline(file, line) && line.rfind("DATA", 0) != 0) continue;
  PointCloud cloud;
  for (char record[14]; file.read(record, sizeof record);) {
    float xyz[3];
    std::memcpy(xyz, record, sizeof xyz);
    cloud.points.emplace_back(xyz[0], xyz[1], xyz[2]);
    cloud.rings.push_back(std::uint8_t(record[13]));
  }
  return cloud;
}

TEST(ScanNeighbors, are_exact_on_real_scans) {
  for (const char* const name : {"vlp16-outdoor-loop", "vlp16-corridor", "rs16-static-room"}) {
    const std::filesystem::path folder = recording(name) / "scans";
    NEEDS(folder);
    int n = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (n++ % 19 != 0) continue;
      SCOPED_TRACE(entry.path().string());
      const PointCloud scan = read_scan(entry.path());
      ASSERT_GT(scan.size(), 1000u);
      ASSERT_NO_FATAL_FAILURE(expect_exact(scan, scan_neighbors(scan, 10), 10));
    }
  }
}

}  // namespace
}  // namespace tilth
