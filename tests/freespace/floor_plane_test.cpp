// The floor as a plane: found tilted and noisy, told from a ceiling, a table and a wall, refused where there is none.
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <tilth/freespace/floor_plane.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kDegree = std::numbers::pi / 180;

/// Points on level ground at `height`, over a rectangle of that size, with 1 cm of noise.
void add_level(Points& points, double height, double width, std::size_t count) {
  std::mt19937 random{unsigned(count)};
  std::uniform_real_distribution<double> place(-width / 2, width / 2);
  std::normal_distribution<double> noise(0, 0.01);
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(place(random), place(random), height + noise(random));
}

void add_wall(Points& points, double x, std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-5, 5), up(-0.8, 2);
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(x, along(random), up(random));
}

/// A room 0.8 m below the sensor and 2 m above it, with a table.
Points room() {
  Points points;
  add_level(points, -0.8, 10, 3000);
  add_level(points, 2.0, 10, 6000);
  add_level(points, -0.1, 1.5, 800);
  add_wall(points, 5, 3000);
  add_wall(points, -5, 3000);
  return points;
}

Pose tilted(double roll, double pitch) {
  return Pose(Eigen::AngleAxisd(pitch * kDegree, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll * kDegree, Eigen::Vector3d::UnitX()));
}

Points moved(Points points, const Pose& T) {
  for (Eigen::Vector3d& p : points) p = T * p;
  return points;
}

TEST(FloorPlane, IsFoundHoweverTheRoomIsTilted) {
  for (const auto& [roll, pitch] : {std::pair(0.0, 0.0), {3.0, -7.0}, {-20.0, 25.0}}) {
    const Pose T = tilted(roll, pitch);
    const auto floor = find_floor(moved(room(), T), Eigen::Vector3d::Zero());
    ASSERT_TRUE(floor) << roll << " " << pitch;
    EXPECT_LT((floor->normal - T.linear().col(2)).norm(), 2e-3);
    EXPECT_NEAR(floor->depth, 0.8, 0.005);
    EXPECT_NEAR(floor->thickness, 0.01, 0.003);
    EXPECT_GT(floor->points, 2500U);
    const Eigen::Vector3d up = levelling(*floor) * floor->normal;
    EXPECT_LT((up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(std::cos(tilt_of(*floor)), T.linear()(2, 2), 1e-3);
  }
}

TEST(FloorPlane, LevellingTurnsNothingThatIsLevelAndNoHeading) {
  EXPECT_LT((levelling({}).matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-15);
  const Pose T = tilted(0, 10);
  const Pose back = levelling({T.linear().col(2), 1, 0, 1000});
  EXPECT_LT((back * T).linear().col(0).cross(Eigen::Vector3d::UnitX()).norm(), 1e-9);
}

TEST(FloorPlane, IsTheSameForTheSamePoints) {
  const auto first = find_floor(room(), Eigen::Vector3d::Zero()), second = find_floor(room(), Eigen::Vector3d::Zero());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->normal, second->normal);
}

TEST(FloorPlane, NothingWhereThereIsNone) {
  const Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
  EXPECT_FALSE(find_floor({}, sensor));
  Points walls, ceiling, ramp, line, pit;
  add_wall(walls, 3, 3000), add_wall(walls, -3, 3000);
  EXPECT_FALSE(find_floor(walls, sensor)) << "walls";
  add_level(ceiling, 1.5, 10, 3000);
  EXPECT_FALSE(find_floor(ceiling, sensor)) << "above the sensor";
  add_level(ramp, -0.8, 10, 3000);
  EXPECT_FALSE(find_floor(moved(ramp, tilted(0, 60)), sensor)) << "steeper than a robot stands";
  for (int i = 0; i < 3000; ++i) line.emplace_back(-5 + i / 300.0, 0.0, -1.0);
  EXPECT_FALSE(find_floor(line, sensor)) << "one line says nothing of the tilt across it";
  add_level(pit, -0.5, 10, 3000);
  add_level(pit, -3, 10, 2500);
  EXPECT_FALSE(find_floor(pit, sensor)) << "much lies below it: a table, or a platform";
}

}  // namespace
}  // namespace tilth
