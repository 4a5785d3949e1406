#include <numbers>

#include <gtest/gtest.h>

#include "localization/made_map.hpp"
#include <tilth/core/se3.hpp>
#include <tilth/localization/place_search.hpp>

namespace tilth {
namespace {

/// A wall of flat patches from a to b, a patch every 0.2 m, seen from its left.
void add_wall_patches(SurfacePatches& patches, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = (b - a).normalized();
  for (double s = 0; s < (b - a).norm(); s += 0.2) {
    SurfacePatch patch;
    patch.mean = a + s * along;
    patch.normal = Eigen::Vector3d::UnitZ().cross(along);
    patch.flat = true;
    patches.push_back(patch);
  }
}

/// A room with a niche, unlike itself whichever way it is turned.
SurfacePatches room(const Eigen::Vector3d& corner) {
  const std::vector<Eigen::Vector3d> outline{{0, 0, 0}, {12, 0, 0}, {12, 5, 0}, {9, 5, 0},
                                             {9, 8, 0}, {4, 8, 0},  {4, 6, 0},  {0, 6, 0}};
  SurfacePatches patches;
  for (std::size_t i = 0; i < outline.size(); ++i)
    for (int twice = 0; twice < 2; ++twice)
      add_wall_patches(patches, corner + outline[i], corner + outline[(i + 1) % outline.size()]);
  return patches;
}

SurfacePatches seen_from(const SurfacePatches& patches_in_map, const Pose& T_map_lidar) {
  SurfacePatches seen = patches_in_map;
  const Pose T_lidar_map = T_map_lidar.inverse();
  for (SurfacePatch& patch : seen)
    patch.mean = T_lidar_map * patch.mean, patch.normal = T_lidar_map.linear() * patch.normal;
  return seen;
}

Pose at(double x, double y, double yaw) {
  return Pose(Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

MadeMap map_with_ways(const SurfacePatches& patches, const std::vector<Pose>& places) {
  MadeMap map;
  for (const Pose& place : places) map.add({.T_map_lidar = place}, seen_from(patches, place));
  return map;
}

TEST(PlaceSearch, FindsEveryHeading) {
  const SurfacePatches patches = room({0, 0, 0});
  const MadeMap map = map_with_ways(patches, {at(3, 3, 0), at(7, 4, 1)});
  const PlaceSearch search(map, {});
  for (double yaw = -3; yaw < 3.2; yaw += 0.7) {
    const Pose truth = at(6.3, 3.2, yaw);
    const std::vector<PlaceCandidate> found = search.find(seen_from(patches, truth));
    ASSERT_FALSE(found.empty());
    const Pose error = truth.inverse() * found[0].T_map_lidar;
    EXPECT_LT(error.translation().norm(), 0.6) << yaw;
    EXPECT_LT(angle_of(error), 0.1) << yaw;
    EXPECT_GT(found[0].score, 0.8) << yaw;
  }
}

TEST(PlaceSearch, FindsBothOfTwoRoomsThatAreAlike) {
  SurfacePatches both = room({0, 0, 0});
  const SurfacePatches one = both, other = room({30, 10, 0});
  both.insert(both.end(), other.begin(), other.end());
  const MadeMap map = map_with_ways(both, {at(5, 3, 0), at(35, 13, 0)});
  PlaceSearchOptions near;
  near.range = 12;
  const std::vector<PlaceCandidate> found = PlaceSearch(map, near).find(seen_from(one, at(5, 3, 0.5)));
  const auto holds = [&](const Pose& place) {
    return std::any_of(found.begin(), found.end(), [&](const PlaceCandidate& c) {
      return (c.T_map_lidar.translation() - place.translation()).norm() < 0.6;
    });
  };
  EXPECT_TRUE(holds(at(5, 3, 0.5)));
  EXPECT_TRUE(holds(at(35, 13, 0.5)));
}

TEST(PlaceSearch, HasNoAnswerWhereNothingStands) {
  const MadeMap map = map_with_ways(room({0, 0, 0}), {at(3, 3, 0)});
  EXPECT_TRUE(PlaceSearch(map, {}).find({}).empty());
  MadeMap bare;
  bare.add({}, {});
  EXPECT_TRUE(PlaceSearch(bare, {}).find(room({0, 0, 0})).empty());
}

TEST(UprightCells, AreThoseSeenTwiceAndInOrder) {
  UprightGatherer gatherer;
  SurfacePatch wall, floor, pole;
  wall.mean = {4.1, -2.6, 0.3}, wall.normal = Eigen::Vector3d::UnitY(), wall.flat = true;
  floor.mean = {1, 1, 0}, floor.normal = Eigen::Vector3d::UnitZ(), floor.flat = true;
  pole.mean = {-3, 7, 0}, pole.normal = Eigen::Vector3d::UnitX();
  gatherer.add({wall, floor, pole}, Pose::Identity());
  EXPECT_TRUE(gatherer.cells().empty());
  gatherer.add({wall, floor, pole}, Pose::Identity());
  const std::vector<UprightCell> cells = gatherer.cells();
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[0].x, 8);
  EXPECT_EQ(cells[0].y, -5);
  EXPECT_EQ(cells[0].facings, 1 << 2);
  EXPECT_EQ(cells[1].facings, 255);
}

}  // namespace
}  // namespace tilth
