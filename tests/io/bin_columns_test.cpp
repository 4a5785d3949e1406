// Columns of files without a header, told by their values.
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include <tilth/io/bin_columns.hpp>
#include <tilth/io/kitti_bin.hpp>

namespace tilth {
namespace {

struct Point {
  double x, y, z, intensity, ring, time;
};

/// A spinning sensor of 16 beams over ground and walls, in the order of firing or ring by ring.
std::vector<Point> points_of(std::size_t count, bool by_ring) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.01, 0.01);
  std::vector<Point> points;
  const std::size_t columns = count / 16 + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t ring = by_ring ? i / columns : i % 16, column = by_ring ? i % columns : i / 16;
    const double turned = double(column) / double(columns), azimuth = 2 * std::numbers::pi * turned;
    const double elevation = (-15.0 + 2.0 * double(ring)) * std::numbers::pi / 180;
    const double range = std::min(12.0 + 3 * std::cos(3 * azimuth), elevation < 0 ? -1.2 / std::sin(elevation) : 90.0);
    points.push_back({range * std::cos(azimuth) + noise(random), range * std::sin(azimuth) + noise(random),
                      range * std::tan(elevation), double(random() % 256), double(ring), 0.1 * turned});
  }
  return points;
}

template <class... F>
std::vector<std::byte> bytes_of_points(const std::vector<Point>& points, F... fields) {
  std::vector<std::byte> bytes;
  for (const Point& point : points) {
    for (const double value : {double(fields(point))...}) {
      const auto raw = std::bit_cast<std::array<std::byte, 4>>(float(value));
      bytes.insert(bytes.end(), raw.begin(), raw.end());
    }
  }
  return bytes;
}

const auto x = [](const Point& p) { return p.x; };
const auto y = [](const Point& p) { return p.y; };
const auto z = [](const Point& p) { return p.z; };
const auto i = [](const Point& p) { return p.intensity; };
const auto unit_i = [](const Point& p) { return p.intensity / 255; };
const auto ring = [](const Point& p) { return p.ring; };
const auto time_of = [](const Point& p) { return p.time; };
const auto before_end = [](const Point& p) { return p.time - 0.1; };
const auto zero = [](const Point&) { return 0.0; };

using Names = std::vector<std::string>;

TEST(BinColumns, AreToldWhateverTheSizeIsDivisibleBy) {
  for (const bool by_ring : {false, true}) {
    for (const std::size_t count : {6000u, 6001u, 6144u, 20000u, 61440u}) {
      const std::vector<Point> points = points_of(count, by_ring);
      SCOPED_TRACE(std::to_string(count) + (by_ring ? " by ring" : " by firing"));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, i)), (Names{"x", "y", "z", "intensity"}));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, unit_i)), (Names{"x", "y", "z", "intensity"}));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, i, ring)), (Names{"x", "y", "z", "intensity", "ring"}));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, unit_i, zero)),
                (Names{"x", "y", "z", "intensity", "column5"}));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, i, ring, time_of)),
                (Names{"x", "y", "z", "intensity", "ring", "time"}));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, i, ring, before_end)),
                (Names{"x", "y", "z", "intensity", "ring", "time"}));
      EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z)), (Names{"x", "y", "z"}));
    }
  }
}

TEST(BinColumns, CoordinatesMayBeMissing) {
  std::vector<Point> points = points_of(8000, false);
  for (std::size_t k = 0; k < points.size(); k += 3) points[k].x = points[k].y = points[k].z = std::nan("");
  EXPECT_EQ(bin_columns(bytes_of_points(points, x, y, z, i, ring)), (Names{"x", "y", "z", "intensity", "ring"}));
}

TEST(BinColumns, OfWhatIsNoScanAreNone) {
  std::mt19937 random(5);
  std::vector<std::byte> noise(96000);
  for (std::byte& byte : noise) byte = std::byte(random());
  EXPECT_FALSE(bin_columns(noise));
  expect_error([&] { parse_kitti_bin(noise, "a.bin"); }, {"a.bin", "96000 bytes", "not x y z intensity"});
  const std::vector<std::byte> whole = bytes_of_points(points_of(8000, false), x, y, z, i, ring);
  expect_error([&] { parse_kitti_bin({whole.begin(), whole.end() - 7}, "a.bin"); }, {"159993 bytes", "truncated"});
}

TEST(BinColumns, CorruptBytesAreReadOrRefused) {
  expect_corruption_survived(bytes_of_points(points_of(100, false), x, y, z, i, ring), 300,
                             [](const std::vector<std::byte>& bytes) { parse_kitti_bin(bytes, "a.bin"); });
}

}  // namespace
}  // namespace tilth
