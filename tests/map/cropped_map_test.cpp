// FLOAM's map: its box, its voxels, and how they forget.
#include <gtest/gtest.h>

#include <tilth/map/cropped_map.hpp>

namespace tilth {
namespace {

using Points = std::vector<Eigen::Vector3d>;

TEST(CroppedMap, KeepsABoxOfAHundredMetresToEachSide) {
  CroppedMap map({.voxel_size = 0.4});
  map.insert(Points{{99, 0, 0}, {101, 0, 0}, {0, -99, 99}, {0, -101, 0}, {90, 90, 90}}, Eigen::Vector3d::Zero());
  EXPECT_EQ(map.cloud().size(), 3u);
  map.insert(Points{}, {0, 20, 0});  // the corner stays, the far end of the other side goes
  EXPECT_EQ(map.cloud().size(), 2u);
  EXPECT_EQ(map.cloud().nearest({80, 80, 80})->index, 1u);
}

TEST(CroppedMap, GivesTheNewPointOfAVoxelAsMuchSayAsAllBefore) {
  CroppedMap map({.voxel_size = 1.0});
  const Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (int i = 0; i < 10; ++i) map.insert(Points{{0.1, 0.5, 0.5}}, center);
  map.insert(Points{{0.5, 0.5, 0.5}}, center);
  ASSERT_EQ(map.cloud().size(), 1u);
  EXPECT_NEAR(map.cloud().points()[0].x(), 0.3, 1e-12);
}

TEST(CroppedMap, BeginsWithTheFirstScanAsItIs) {
  CroppedMap map({.voxel_size = 1.0});
  map.reset({{0.1, 0, 0}, {0.2, 0, 0}, {500, 0, 0}});
  EXPECT_EQ(map.cloud().size(), 3u);
  std::vector<Neighbor> neighbors;
  map.cloud().knn({0, 0, 0}, 2, neighbors);
  ASSERT_EQ(neighbors.size(), 2u);
  EXPECT_EQ(neighbors[1].index, 1u);
}

}  // namespace
}  // namespace tilth
