#include <random>
#include <set>

#include <gtest/gtest.h>

#include <tilth/freespace/beam_walk.hpp>

namespace tilth {
namespace {

std::set<std::array<int, 3>> cells_walked(const BeamStretch& beam, float cell) {
  std::set<std::array<int, 3>> cells;
  walk(beam, cell, [&](const Eigen::Vector3i& c, float) { cells.insert({c.x(), c.y(), c.z()}); });
  return cells;
}

TEST(BeamWalk, VisitsTheCellsThatSmallStepsAlongTheBeamVisit) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> within(-3.0F, 3.0F);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f from(within(random), within(random), within(random));
    const Eigen::Vector3f way = Eigen::Vector3f(within(random), within(random), within(random)) - from;
    const BeamStretch beam{from, way.normalized(), 0.3F, way.norm()};
    const std::set<std::array<int, 3>> walked = cells_walked(beam, 0.2F);
    std::size_t found = 0, missing = 0;
    for (float along = beam.begin; along < beam.end; along += 0.0005F) {
      const Eigen::Vector3i c = voxel_of(((from + along * beam.direction) / 0.2F).cast<double>());
      ++(walked.contains({c.x(), c.y(), c.z()}) ? found : missing);
    }
    EXPECT_LE(missing * 1000, found) << i;  // of rounding, at the sides of cells
  }
}

TEST(BeamWalk, GoesStraightAlongAnAxis) {
  const BeamStretch beam{{0.5F, 0.5F, 0.5F}, {-1, 0, 0}, 0, 3};
  std::vector<int> columns;
  walk(beam, 1.0F, [&](const Eigen::Vector3i& c, float) { columns.push_back(c.x()); });
  EXPECT_EQ(columns, (std::vector<int>{0, -1, -2, -3}));
}

TEST(BeamWalk, VisitsNothingWhereTheBeamEndsBeforeItBegins) {
  int visits = 0;
  walk({{0, 0, 0}, {1, 0, 0}, 0.5F, 0.2F}, 0.1F, [&](const Eigen::Vector3i&, float) { ++visits; });
  EXPECT_EQ(visits, 0);
}

}  // namespace
}  // namespace tilth
