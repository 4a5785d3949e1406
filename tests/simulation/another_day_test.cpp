#include <gtest/gtest.h>

#include <tilth/simulation/another_day.hpp>
#include <tilth/simulation/layout.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

bool same_vertices(const Scene& a, const Scene& b) {
  return a.mesh.vertices == b.mesh.vertices && a.mesh.triangles.size() == b.mesh.triangles.size();
}

TEST(AnotherDay, AWorldStaysWhereItsSeedDoes) {
  for (const char* name : {"office", "corridor", "hospital", "plaza", "street"}) {
    const Scene own = make_scene(name, {.seed = 5}), again = make_scene(name, {.seed = 9, .world_seed = 5});
    EXPECT_TRUE(same_vertices(own, again)) << name;
    EXPECT_NE(own.trajectory.back().T_world_lidar.matrix(), again.trajectory.back().T_world_lidar.matrix()) << name;
  }
}

TEST(AnotherDay, PeopleWalkElsewhere) {
  const Scene own = make_scene("office", {.seed = 5}), again = make_scene("office", {.seed = 9, .world_seed = 5});
  ASSERT_FALSE(own.movers.walkers.empty() || again.movers.walkers.empty());
  EXPECT_NE(own.movers.walkers[0].start, again.movers.walkers[0].start);
}

TEST(AnotherDay, AsManyThingsChangeAsAskedFor) {
  const Scene before = make_scene("hospital", {.seed = 5});
  Scene after = before;
  change(after, {.seed = 9, .changed = 0.5});
  std::size_t moved = 0;
  for (const MovablePart& part : before.mesh.movables)
    moved += before.mesh.vertices[part.vertices[0]] != after.mesh.vertices[part.vertices[0]];
  const double all = double(before.mesh.movables.size());
  EXPECT_GT(all, 20);
  EXPECT_GT(double(moved) / all, 0.02);
  EXPECT_LT(double(moved) / all, 0.35);
  EXPECT_NE(after.mesh.triangles.size(), before.mesh.triangles.size());
  Scene other = before;
  change(other, {.seed = 10, .changed = 0.5});
  EXPECT_FALSE(same_vertices(after, other));
}

TEST(AnotherDay, TheWayStaysFree) {
  Scene scene = make_scene("plaza", {.seed = 5});
  const std::size_t before = scene.mesh.vertices.size();
  change(scene, {.seed = 9, .changed = 1.0});
  const Path way = footprint(scene.trajectory);
  for (std::size_t i = before; i < scene.mesh.vertices.size(); i += 7)
    EXPECT_GT(distance_to(way, scene.mesh.vertices[i]), 0.8);
}

TEST(AnotherDay, AKidnappedSensorIsFartherAlongItsWay) {
  const SceneOptions options{.seed = 5, .kidnap = 20, .kidnap_jump = 10, .covered = 5};
  const Trajectory way = make_scene("office", {.seed = 5}).trajectory, jumped = kidnapped(way, options);
  const auto at = [](const Trajectory& trajectory, double stamp) {
    return Eigen::Vector3d(interpolate(trajectory, stamp).translation());
  };
  EXPECT_LT((at(way, 19.9) - at(jumped, 19.9)).norm(), 1e-9);
  EXPECT_NEAR((at(jumped, 20.1) - at(way, 20.0)).norm(), 10, 0.1);  // the way is straight there
  EXPECT_LT((at(jumped, 20.1) - at(jumped, 24.9)).norm(), 1e-9);
  EXPECT_GT((at(jumped, 25.1) - at(jumped, 27.0)).norm(), 0.5);
  EXPECT_TRUE(is_covered(20.0, options) && is_covered(24.9, options));
  EXPECT_FALSE(is_covered(19.9, options) || is_covered(25.0, options));
}

TEST(AnotherDay, AKidnappingThatCannotBeIsRefused) {
  EXPECT_THROW(make_scene("office", {.seed = 5, .kidnap = 1000}), Error);
  EXPECT_THROW(make_scene("office", {.seed = 5, .kidnap = 20, .kidnap_jump = 1000}), Error);
}

TEST(AnotherDay, ACoveredSensorSeesNothing) {
  const Simulator simulator(
      "office",
      simulation_options(
          "office",
          {{"kidnap", "1"}, {"covered", "1"}, {"duration", "12"}, {"columns", "100"}, {"kidnap_jump", "0.1"}}));
  EXPECT_FALSE(simulator.scan(2).scan.cloud.empty());
  EXPECT_TRUE(simulator.scan(14).scan.cloud.empty());
  EXPECT_TRUE(simulator.scan(14).labels.empty());
}

}  // namespace
}  // namespace tilth
