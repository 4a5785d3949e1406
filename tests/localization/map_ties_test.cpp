#include <gtest/gtest.h>

#include "localization/made_map.hpp"
#include <tilth/localization/gone_surfaces.hpp>
#include <tilth/localization/map_ties.hpp>

namespace tilth {
namespace {

Simulator drive_in(const CorridorPlan& plan, int seed) {
  const std::vector<Leg> legs{{1, 0, 0}, {12, 1.0, 0}, {1, 0, 0}};
  const OptionValues values{{"seed", std::to_string(seed)}, {"people", "0"}, {"columns", "600"}};
  return Simulator(corridor_scene(plan, legs), simulation_options("corridor", values));
}

const CorridorPlan kPlan{26, {3, 4.7, 9, 13, 14.5, 19, 21, 23.5}};

/// The same map in another frame.
MadeMap shifted(const MadeMap& map, const Pose& T_other_map) {
  MadeMap other;
  for (std::size_t i = 0; i < map.places().size(); ++i) {
    MapPlace place = map.places()[i];
    place.T_map_lidar = T_other_map * place.T_map_lidar;
    other.add(place, map.patches(i));
  }
  return other;
}

PoseGraph chain_of(const MadeMap& map) {
  PoseGraph graph;
  for (const MapPlace& place : map.places()) {
    if (!graph.poses.empty()) {
      graph.constraints.push_back({graph.poses.size() - 1, graph.poses.size(),
                                   graph.poses.back().inverse() * place.T_map_lidar, Matrix6d::Identity(), false});
    }
    graph.poses.push_back(place.T_map_lidar);
  }
  return graph;
}

TEST(MapTies, JoinTwoDrivesThroughOneCorridor) {
  const Pose T_other_map(Eigen::Translation3d(40, -7, 0) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  const MadeMap map = map_of(drive_in(kPlan, 401)), other = shifted(map_of(drive_in(kPlan, 402)), T_other_map);
  const std::vector<MapTie> ties = find_ties(map, other, {}, 3.0);
  ASSERT_GE(ties.size(), 3U);
  for (const MapTie& tie : ties) {
    const Pose expected = T_other_map.inverse() * other.places()[tie.place].T_map_lidar;
    EXPECT_LT((tie.T_map_place.translation() - expected.translation()).norm(), 0.05) << tie.place;
  }
  const PoseGraph graph = joined(chain_of(map), chain_of(other), ties);
  ASSERT_EQ(graph.poses.size(), map.places().size() + other.places().size());
  EXPECT_EQ(graph.constraints.size(), graph.poses.size() - 2 + ties.size());
  for (std::size_t i = 0; i < other.places().size(); ++i) {
    const Pose expected = T_other_map.inverse() * other.places()[i].T_map_lidar;
    EXPECT_LT((graph.poses[map.places().size() + i].translation() - expected.translation()).norm(), 0.1);
  }
}

TEST(MapTies, AreNoneBetweenTwoCorridors) {
  const MadeMap map = map_of(drive_in(kPlan, 403));
  const MadeMap other = map_of(drive_in({40, {2, 5.5, 8, 11, 17.5, 22, 24, 28.5, 33}, false}, 404));
  EXPECT_TRUE(find_ties(map, other, {}, 4.0).empty());
}

/// A wall across +x, seen from the origin.
SurfacePatches wall_at(double x) {
  SurfacePatches patches;
  for (double y = -1; y < 1.1; y += 0.2) {
    for (double z = -0.5; z < 0.6; z += 0.2) {
      SurfacePatch patch;
      patch.mean = {x, y, z}, patch.normal = -Eigen::Vector3d::UnitX(), patch.flat = true;
      patch.covariance = Eigen::Vector3d(1e-6, 0.01, 0.01).asDiagonal();
      patches.push_back(patch);
    }
  }
  return patches;
}

TEST(GoneSurfaces, AreThoseThatBeamsFromThreePlacesWentThrough) {
  PatchMap map({});
  const SurfacePatches there = wall_at(3.1);
  for (int times = 0; times < 5; ++times) map.insert(there, Pose::Identity());
  GoneSurfaces gone({});
  const auto count = [&] {
    return std::count_if(there.begin(), there.end(), [&](const SurfacePatch& patch) { return gone.holds(patch); });
  };
  for (int look = 0; look < 3; ++look) {
    EXPECT_EQ(count(), 0) << look;
    gone.look(wall_at(6.0), Pose(Eigen::Translation3d(0, 0.02 * look, 0)), map);
  }
  EXPECT_GT(count(), 20);
  GoneSurfaces kept({});
  for (int look = 0; look < 4; ++look) kept.look(wall_at(3.1), Pose::Identity(), map);
  EXPECT_FALSE(std::any_of(there.begin(), there.end(), [&](const SurfacePatch& patch) { return kept.holds(patch); }));
}

}  // namespace
}  // namespace tilth
