// Floor plans of rooms made by hand: what is floor, wall and unknown is known for every cell.
#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/freespace/occupancy_grid.hpp>

namespace tilth {
namespace {

constexpr float kHeight = 0.8F;  // of the sensor above the floor

/// The floor of a hall of 8 x 6 m whose ground rises by `slope` along x, its walls, and a table of 0.7 m at (2, 1);
/// beyond the walls nothing. The sensor goes along the middle; every point is seen from the nearest place of its way.
struct Hall {
  float slope = 0;
  std::vector<Eigen::Vector3f> way;
  std::vector<SeenPoint> seen;

  explicit Hall(float rise) : slope(rise) {
    for (float x = -3; x <= 3; x += 0.1F) way.emplace_back(x, 0.0F, slope * x + kHeight);
    for (float x = -4; x <= 4; x += 0.08F) {
      for (float y = -3; y <= 3; y += 0.08F) add(x, y, 0);
      for (float h = 0; h < 2.5F; h += 0.08F) add(x, -3, h), add(x, 3, h);
    }
    for (float y = -3; y <= 3; y += 0.08F) {
      for (float h = 0; h < 2.5F; h += 0.08F) add(-4, y, h), add(4, y, h);
    }
    for (float h = 0.05F; h < 0.7F; h += 0.04F) {
      for (float a = -0.3F; a <= 0.3F; a += 0.04F) add(2 + a, 0.7F, h);
    }
  }

  void add(float x, float y, float above, bool moving = false) {
    const float from = std::clamp(x, -3.0F, 3.0F);
    seen.push_back({{x, y, slope * x + above}, {from, 0.0F, slope * from + kHeight}, moving});
  }
};

Occupancy at(const OccupancyGrid& grid, double x, double y) {
  const int c = int(std::floor((x - grid.origin.x()) / grid.resolution));
  const int r = int(std::floor((y - grid.origin.y()) / grid.resolution));
  return grid.contains(c, r) ? grid.at(c, r) : Occupancy::unknown;
}

/// Whether a cell is occupied that the place lies in or at the side of.
bool is_wall(const OccupancyGrid& grid, double x, double y) {
  for (const double aside : {-0.02, 0.02}) {
    if (at(grid, x, y + aside) == Occupancy::occupied) return true;
  }
  return false;
}

class Halls : public testing::TestWithParam<float> {};

TEST_P(Halls, FloorIsFreeWallsAreOccupiedAndNothingIsKnownBeyond) {
  const Hall hall(GetParam());
  const OccupancyGrid grid = occupancy_of(hall.seen, hall.way, {});
  std::size_t free = 0, floor = 0;
  for (double x = -3.8; x < 3.8; x += 0.05) {
    for (double y = -2.8; y < 2.8; y += 0.05) {
      if (std::abs(x - 2) < 0.6 && y > 0.5) continue;  // the table, and what lies behind it
      ++floor;
      free += at(grid, x, y) == Occupancy::free ? 1 : 0;
    }
  }
  EXPECT_GT(double(free), 0.99 * double(floor));
  for (double x = -3.9; x < 3.9; x += 0.1) {
    for (const double side : {-1.0, 1.0}) {
      EXPECT_TRUE(is_wall(grid, x, side * 3)) << x << ' ' << side;
      EXPECT_EQ(at(grid, x, side * 3.1), Occupancy::unknown) << x << ' ' << side;
    }
  }
  EXPECT_TRUE(is_wall(grid, 2, 0.7));
}

INSTANTIATE_TEST_SUITE_P(LevelAndRamp, Halls, testing::Values(0.0F, 0.15F));

TEST(Occupancy, WhatMovesIsNoObstacle) {
  Hall hall(0);
  for (float h = 0.1F; h < 1.7F; h += 0.05F) {
    for (float a = -0.2F; a < 0.2F; a += 0.05F) hall.add(a, 1, h, true);
  }
  EXPECT_EQ(at(occupancy_of(hall.seen, hall.way, {}), 0, 1), Occupancy::free);
}

TEST(Occupancy, SeesNothingFreeThroughAWall) {
  Hall hall(0);
  for (float x = -3; x < 3; x += 0.02F) hall.add(x, 5, 0.9F);  // strays behind the wall
  const OccupancyGrid grid = occupancy_of(hall.seen, hall.way, {});
  for (double x = -3; x < 3; x += 0.05) {
    for (double y = 3.1; y < 4.8; y += 0.05) EXPECT_NE(at(grid, x, y), Occupancy::free);
  }
}

TEST(Occupancy, WhatIsHigherThanTheBandIsNoObstacle) {
  Hall hall(0);
  for (float a = -0.2F; a < 0.2F; a += 0.02F) hall.add(a, 1, 2.2F);
  EXPECT_EQ(at(occupancy_of(hall.seen, hall.way, {}), 0, 1), Occupancy::free);
  EXPECT_TRUE(is_wall(occupancy_of(hall.seen, hall.way, {.high = 2.4}), 0, 1));
}

TEST(Occupancy, RefusesWhatItCannotHold) {
  const Hall hall(0);
  EXPECT_THROW(occupancy_of(hall.seen, hall.way, {.low = 2, .high = 1}), Error);
  EXPECT_THROW(occupancy_of(hall.seen, hall.way, {.resolution = 1e-4}), Error);
  EXPECT_EQ(occupancy_of({}, {}, {}).cells.size(), 0U);
}

}  // namespace
}  // namespace tilth
