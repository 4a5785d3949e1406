#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "search/generated_scans.hpp"
#include "search/neighbor_checks.hpp"
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

}  // namespace
}  // namespace tilth
