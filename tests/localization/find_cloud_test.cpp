#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/se3.hpp>
#include <tilth/localization/find_cloud.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

/// Scans of a drive, each taken at once, and where they were taken.
struct MadeScans {
  std::vector<PointCloud> clouds;
  std::vector<Pose> T_world_lidar;
};

MadeScans scans_of(const std::string& scene, const std::vector<std::size_t>& which) {
  const OptionValues options{
      {"seed", "611"}, {"duration", "12"}, {"snapshot", "true"}, {"people", "0"}, {"columns", "900"}};
  const Simulator simulator(scene, simulation_options(scene, options));
  MadeScans made;
  for (const std::size_t i : which) {
    const Scan scan = simulator.scan(i).scan;
    made.clouds.push_back(scan.cloud);
    made.T_world_lidar.push_back(interpolate(simulator.truth(), scan.stamp));
  }
  return made;
}

/// Turned about z by `yaw` and tilted by `tilt` [rad] about a level axis that `towards` tells.
Pose turn(double yaw, double tilt, double towards) {
  const Eigen::Vector3d axis(std::cos(towards), std::sin(towards), 0);
  return Pose(Eigen::AngleAxisd(tilt, axis) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

void expect_near(const Pose& found, const Pose& expected) {
  const Pose error = expected.inverse() * found;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_LT(angle_of(error), 0.01);
}

TEST(FindCloud, FindsACloudHoweverItIsTurned) {
  const MadeScans made = scans_of("plaza", {40, 55});
  const Pose T_0_1 = made.T_world_lidar[0].inverse() * made.T_world_lidar[1];
  ASSERT_GT(T_0_1.translation().norm(), 0.5);
  std::mt19937 random(612);
  std::uniform_real_distribution<double> half_turns(-std::numbers::pi, std::numbers::pi), tilts(0, 0.3);
  for (int k = 0; k < 6; ++k) {
    const Pose T_turned_1 = turn(half_turns(random), tilts(random), half_turns(random));
    const FoundCloud found = find_cloud(transform(made.clouds[1], T_turned_1), made.clouds[0]);
    ASSERT_EQ(found.answer, PlaceAnswer::found);
    EXPECT_TRUE(found.registration.converged);
    expect_near(found.registration.T_target_source, T_0_1 * T_turned_1.inverse());
  }
}

TEST(FindCloud, NeverFindsAnotherScene) {
  const MadeScans plaza = scans_of("plaza", {0, 40}), office = scans_of("office", {0, 40}),
                  corridor = scans_of("corridor", {0, 40});
  for (const MadeScans* one : {&plaza, &office, &corridor}) {
    for (const MadeScans* other : {&plaza, &office, &corridor}) {
      for (int k = 0; one != other && k < 4; ++k) {
        const FoundCloud found = find_cloud(one->clouds[std::size_t(k % 2)], other->clouds[std::size_t(k / 2)]);
        EXPECT_NE(found.answer, PlaceAnswer::found);
        EXPECT_FALSE(found.registration.converged);
      }
    }
  }
}

/// A square hall as a sensor with 16 beams in its middle sees it; with a pillar beside or without.
PointCloud square_hall(bool with_pillar) {
  constexpr double kHalf = 6.0, kHeight = 1.0;  // [m] from its middle to a wall, of the sensor above the floor
  PointCloud hall;
  for (int ring = 0; ring < 16; ++ring) {
    const double up = (2 * ring - 15) * std::numbers::pi / 180;
    for (int column = 0; column < 1800; ++column) {
      const double yaw = column * std::numbers::pi / 900;
      const Eigen::Vector3d beam(std::cos(up) * std::cos(yaw), std::cos(up) * std::sin(yaw), std::sin(up));
      double range = kHalf / beam.head<2>().lpNorm<Eigen::Infinity>();
      if (beam.z() < 0) range = std::min(range, -kHeight / beam.z());
      const double to_pillar = 3.0 / beam.x();  // the face of a pillar 3 m wide, 3 m ahead and to the left
      if (with_pillar && beam.x() > 0 && std::abs(to_pillar * beam.y() - 2.0) < 1.5) range = std::min(range, to_pillar);
      hall.points.emplace_back(range * beam);
      hall.rings.push_back(std::uint16_t(ring));
    }
  }
  return hall;
}

TEST(FindCloud, SaysWhereSeveralWaysFitAlike) {
  const Pose T_turned = turn(0.7, 0, 0);
  const PointCloud hall = square_hall(false);
  const FoundCloud found = find_cloud(transform(hall, T_turned), hall);
  EXPECT_EQ(found.answer, PlaceAnswer::ambiguous);
  EXPECT_EQ(found.hypotheses.size(), 4U);
  EXPECT_FALSE(found.registration.converged);
  const PointCloud marked = square_hall(true);
  const FoundCloud found_marked = find_cloud(transform(marked, T_turned), marked);
  ASSERT_EQ(found_marked.answer, PlaceAnswer::found);
  expect_near(found_marked.registration.T_target_source, T_turned.inverse());
}

TEST(FindCloud, WithoutPointsNothingIsFound) {
  const PointCloud hall = square_hall(true);
  EXPECT_EQ(find_cloud({}, hall).answer, PlaceAnswer::not_found);
  EXPECT_EQ(find_cloud(hall, {}).answer, PlaceAnswer::not_found);
  PointCloud floor;
  for (int i = 0; i < 10000; ++i) floor.points.emplace_back(0.1 * (i % 100) - 5, 0.1 * double(i / 100) - 5, -1);
  EXPECT_EQ(find_cloud(floor, floor).answer, PlaceAnswer::not_found);
}

}  // namespace
}  // namespace tilth
