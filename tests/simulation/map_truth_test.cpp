// Maps of a known room: shifted, thickened, half left out; and the nearest point of a mesh by search.
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/simulation/map_truth.hpp>
#include <tilth/simulation/mesh_points.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

// A room of 8 x 6 x 3 m with a pillar, seen from inside.
Mesh room_with_pillar() {
  Mesh mesh;
  const SurfaceId wall = add_surface(mesh, {"wall"});
  add_box(mesh, wall, upright({0, 0, 0}, 0), {8, 6, 3});
  add_box(mesh, wall, upright({2, 1, 0}, 0.4), {0.5, 0.5, 3});
  return mesh;
}

// The distance to the nearest of many points of the surface is not below the true one, and hardly above.
TEST(MeshWorld, GivesTheDistanceToTheNearestPointOfItsTriangles) {
  const MeshWorld world(room_with_pillar(), {});
  const std::vector<Vector3d> surface = sampled_surface(world.mesh(), 0.02);
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) points.push_back(Vector3d(6, 5, 3).cwiseProduct(Vector3d(u(rng), u(rng), u(rng))));
  const std::vector<double> found = world.distances(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double least = 1e9;
    for (const Vector3d& p : surface) least = std::min(least, (p - points[i]).norm());
    EXPECT_LE(found[i], least + 1e-5) << i;
    EXPECT_GE(found[i] + 0.1, least) << i;
  }
}

TEST(MeshPoints, AreSpreadOverTheSurfaceByItsArea) {
  const Mesh mesh = room_with_pillar();
  const std::vector<Vector3d> points = sampled_surface(mesh, 0.05);
  const double area = 2 * (8 * 6 + 8 * 3 + 6 * 3) + 2 * 0.25 + 4 * 1.5;
  EXPECT_NEAR(double(points.size()), area / 0.0025, 2);
  std::size_t floor = 0;
  for (const Vector3d& p : points) floor += std::abs(p.z()) < 1e-9;
  EXPECT_NEAR(double(floor), (48 + 0.25) / 0.0025, 8);
}

TEST(MapTruth, AShiftedFloorLiesAsFarOffAsItWasShifted) {
  Mesh floor;
  add_quad(floor, add_surface(floor, {"floor"}), {-50, -50, 0}, {Vector3d(100, 0, 0), Vector3d(0, 100, 0)}, kNoSides);
  const MeshWorld world(floor, {});
  std::vector<Vector3d> points;
  for (int i = 0; i < 100; ++i) points.push_back({0.1 * i, 0.05 * i, 0.03});
  const MapTruth truth = judge_map(points, world, {}, {});
  for (const double figure : {truth.mean, truth.median, truth.rmse, truth.p95, truth.max})
    EXPECT_NEAR(figure, 0.03, 1e-6);
  EXPECT_EQ(truth.on_surface, 1.0);
  EXPECT_EQ(truth.seen, 0u);
  EXPECT_EQ(truth.completeness, 0.0);
  points.resize(200, {0, 0, 1});
  const MapTruth with_strays = judge_map(points, world, {}, {});
  EXPECT_NEAR(with_strays.on_surface, 0.5, 1e-12);
  EXPECT_NEAR(with_strays.rmse_on_surface, 0.03, 1e-6);
  EXPECT_NEAR(with_strays.rmse, std::sqrt(0.5 * (0.0009 + 1)), 1e-6);
  EXPECT_THROW(judge_map({}, world, {}, {}), Error);
}

TEST(MapTruth, CompletenessCountsWhatTheSensorCouldSee) {
  const MeshWorld world(room_with_pillar(), {});
  const std::vector<Pose> poses{upright({-2, 0, 1.5}, 0)};
  MapTruthOptions options;
  options.lowest = -90, options.highest = 90;
  const std::vector<Vector3d> whole = sampled_surface(world.mesh(), 0.05);
  const MapTruth all = judge_map(whole, world, poses, options);
  EXPECT_GT(all.completeness, 0.999);
  EXPECT_LT(all.mean, 1e-5);
  std::vector<Vector3d> half;
  for (const Vector3d& p : whole) {
    if (p.y() < 0) half.push_back(p);
  }
  const MapTruth some = judge_map(half, world, poses, options);
  EXPECT_EQ(some.seen, all.seen);
  EXPECT_NEAR(some.completeness, 0.5, 0.06);
  EXPECT_LT(double(all.seen),
            double(sampled_surface(world.mesh(), options.spacing).size()) - 300);  // behind the pillar
  options.lowest = -15, options.highest = 15;
  EXPECT_LT(judge_map(whole, world, poses, options).seen, all.seen / 2);
}

}  // namespace
}  // namespace tilth
