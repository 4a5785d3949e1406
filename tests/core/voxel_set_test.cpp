#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <tilth/core/voxel_set.hpp>

namespace tilth {
namespace {

TEST(VoxelSet, HoldsWhatASetOfTheStandardLibraryHolds) {
  std::mt19937 rng(5);
  std::uniform_int_distribution<int> near(-20, 20), far(-VoxelSet::kReach + 1, VoxelSet::kReach - 1);
  std::set<std::tuple<int, int, int>> reference;
  VoxelSet voxels;
  int seen_again = 0;
  for (int i = 0; i < 50000; ++i) {
    auto& u = i % 2 == 0 ? near : far;
    const Eigen::Vector3i v(u(rng), u(rng), u(rng));
    const bool is_new = reference.emplace(v.x(), v.y(), v.z()).second;
    ASSERT_EQ(voxels.insert(v), is_new) << v.transpose();
    seen_again += is_new ? 0 : 1;
  }
  EXPECT_GT(seen_again, 1000);
  voxels.clear();
  EXPECT_TRUE(voxels.insert({3, -4, 5}));
  EXPECT_FALSE(voxels.insert({3, -4, 5}));
}

TEST(VoxelSet, TakesVoxelsOutAgain) {
  VoxelSet voxels;
  voxels.erase({1, 2, 3});  // is not there
  EXPECT_TRUE(voxels.insert({1, 2, 3}));
  EXPECT_TRUE(voxels.insert({1, 2, 4}));
  voxels.erase({1, 2, 3});
  EXPECT_TRUE(voxels.insert({1, 2, 3}));
  EXPECT_FALSE(voxels.insert({1, 2, 4}));
}

TEST(VoxelSet, TellsVoxelsOnBothSidesOfZeroApart) {
  VoxelSet voxels;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = -17; i <= 17; ++i) {
      if (i != 0) {
        EXPECT_TRUE(voxels.insert(i * Eigen::Vector3i::Unit(axis))) << i << " along " << axis;
      }
    }
  }
}

}  // namespace
}  // namespace tilth
